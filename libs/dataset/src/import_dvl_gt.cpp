#include "import_dvl_gt.h"

#include <mrpt/core/format.h>
#include <mrpt/obs/CObservationGPS.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/CObservationPressure.h>
#include <posidonia/obs/observations.h>

#include <algorithm>

#include "dvl_gt_tables.h"
#include "import_output.h"

namespace posidonia
{
using Eigen::Isometry3d;
using mrpt::obs::CObservation;

namespace
{
constexpr double kDegree = M_PI / 180;
constexpr int64_t kGpsTime = 1000000000;  ///< Fixes in the first second only [ns]

/** The ini's, else the first row of GT.csv. */
void chooseDatum(const TDatasetOptions& options, const TTruthRow& first, TDatasetReport& report)
{
	report.datum = options.datum.value_or(TWorldOptions{first.position.latitude, first.position.longitude});
	report.datum_source = options.datum ? "ini" : "first row";
}

/** Rows a second, by the median of their distances. */
template <class ROW>
double rateOf(const std::vector<ROW>& rows)
{
	std::vector<int64_t> periods;
	for (size_t i = 1; i < rows.size(); i++)
		if (rows[i].stamp > rows[i - 1].stamp) periods.push_back(rows[i].stamp - rows[i - 1].stamp);
	if (periods.empty()) return 1;
	const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
	std::nth_element(periods.begin(), middle, periods.end());
	return 1e9 / double(*middle);
}

/** Sensors at the body's origin; the sigmas' sources are in the README. */
TSensorSuite suiteOf(
	const TDvlGtTables& tables, const TDvlGtAgreement& agreement, const TAttitudeErrors& errors)
{
	constexpr size_t kEnoughPings = 10;
	constexpr double kLoggedAttitude = 0.1 * kDegree;
	TSensorSuite suite;
	TDvlSpec& dvl = suite.dvl["DVL"];
	dvl.rate = rateOf(tables.dvl);
	if (agreement.pings >= kEnoughPings) dvl.sigma_velocity = agreement.sigmaDvl();
	dvl.sigma_scale = 0.004;
	TAhrsSpec& ahrs = suite.ahrs["AHRS"];
	ahrs.rate = rateOf(tables.truth);
	ahrs.sigma_roll_pitch = ahrs.sigma_heading = std::max(kLoggedAttitude, errors.noise);
	ahrs.sigma_tilt_bias = ahrs.sigma_heading_bias = errors.bias;
	ahrs.bias_time = errors.bias_time;
	suite.pressure["PRESSURE"].rate = suite.gps["GPS"].rate = ahrs.rate;
	suite.gps["GPS"].sigma_horizontal = 0.1;
	return suite;
}

/** The rows as a source of observations; it ends where `convert` gives none. */
template <class ROW, class CONVERT>
TSource sourceOf(const std::string& label, const std::vector<ROW>& rows, CONVERT convert)
{
	const auto index = std::make_shared<size_t>(0);
	const auto next = [&rows, label, convert, index]() -> std::optional<TStampedObservation> {
		if (*index == rows.size()) return {};
		const ROW& row = rows[(*index)++];
		const CObservation::Ptr observation = convert(row);
		if (!observation) {
			*index = rows.size();
			return {};
		}
		observation->sensorLabel = label;
		observation->timestamp = mrptStamp(row.stamp);
		return TStampedObservation{row.stamp, observation};
	};
	return {label, next};
}

CObservation::Ptr dvlOf(const TDvlRow& row)
{
	auto dvl = CObservationDVL::Create();
	dvl->velocity = {row.velocity.x(), row.velocity.y(), row.velocity.z()};
	dvl->velocity_valid = true;
	return dvl;
}

CObservation::Ptr pressureOf(const TTruthRow& row, const TPressureSpec& spec)
{
	auto pressure = CObservationPressure::Create();
	pressure->pressure = spec.pressureAt(-row.position.height);
	return pressure;
}

CObservation::Ptr gpsOf(const TTruthRow& row)
{
	mrpt::obs::gnss::Message_NMEA_GGA gga;
	gga.fields.latitude_degrees = row.position.latitude;
	gga.fields.longitude_degrees = row.position.longitude;
	gga.fields.altitude_meters = row.position.height;
	gga.fields.fix_quality = 1;
	auto gps = mrpt::obs::CObservationGPS::Create();
	gps->setMsg(gga);
	return gps;
}

std::vector<TSource> sourcesOf(
	const TDvlGtTables& tables, const TSensorSuite& suite, const TAttitudeErrors& attitude_errors)
{
	const auto errors = std::make_shared<CAttitudeErrors>(attitude_errors);
	const auto ahrs = [errors](const TTruthRow& row) {
		return makeAhrs(
			"AHRS", 0, Isometry3d::Identity(), errors->degraded(double(row.stamp) * 1e-9, row.R_map_body));
	};
	const TPressureSpec pressure = suite.pressure.at("PRESSURE");
	const int64_t gps_end = tables.truth.front().stamp + kGpsTime;
	return {
		sourceOf("AHRS", tables.truth, ahrs), sourceOf("DVL", tables.dvl, dvlOf),
		sourceOf(
			"PRESSURE", tables.truth, [pressure](const TTruthRow& row) { return pressureOf(row, pressure); }),
		sourceOf("GPS", tables.truth, [gps_end](const TTruthRow& row) {
			return row.stamp < gps_end ? gpsOf(row) : CObservation::Ptr();
		})};
}

/** What was measured, and the lines that a run over the log needs. */
void fillNotes(
	const TDatasetOptions& options, const TDvlGtAgreement& agreement, const TSensorSuite& suite,
	TDatasetReport& report)
{
	report.warnings = agreement.warnings();
	report.notes = agreement.notes();
	report.notes.push_back(
		mrpt::format("sigma_velocity of the DVL: %.4f m/s", suite.dvl.at("DVL").sigma_velocity));
	const TAttitudeErrors& e = options.attitude_errors;
	if (e.noise > 0 || e.bias > 0)
		report.notes.push_back(mrpt::format(
			"the AHRS has errors: noise %.3f deg, bias %.3f deg over %.0f s, seed %u", e.noise / kDegree,
			e.bias / kDegree, e.bias_time, e.seed));
	report.notes.push_back("to replay it: [World] as above, and [InitialPose] known = false, gps_fixes = 1");
}

std::string tumOf(const std::vector<TTruthRow>& truth, const TWorldOptions& datum)
{
	std::string lines;
	for (const auto& row : truth)
		lines += tumLine(row.stamp, row.T_map_body(datum));
	return lines;
}
}  // namespace

TDatasetReport importDvlGt(const TDatasetOptions& options, const dataset_progress_t& progress)
{
	if (progress) progress("rawlog", 0);
	CBadRows bad(options.skip_bad);
	const TDvlGtTables tables = readDvlGtTables(options.input, bad);
	const TDvlGtAgreement agreement = agreementOf(tables);
	const TSensorSuite suite = suiteOf(tables, agreement, options.attitude_errors);
	TDatasetReport report;
	chooseDatum(options, tables.truth.front(), report);
	fillNotes(options, agreement, suite, report);
	report.bad_rows = bad.count();
	report.warnings.insert(report.warnings.end(), bad.messages().begin(), bad.messages().end());
	report.ground_truth_poses = tables.truth.size();

	CRawlogWriter writer(options.output);
	mergeInto(writer, sourcesOf(tables, suite, options.attitude_errors), report);
	removeEarlier(options.output);
	writeFileWhole(groundTruthPathOf(options.output), [&](std::ostream& out) {
		out << tumOf(tables.truth, *report.datum);
	});
	writeSensors(sensorsPathOf(options.output), suite);
	writer.finish();
	if (progress) progress("rawlog", 1);
	return report;
}
}  // namespace posidonia
