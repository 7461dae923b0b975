#include "dvl_gt_tables.h"

#include <mrpt/core/format.h>
#include <posidonia/base/error.h>
#include <posidonia/dataset/csv_reader.h>
#include <posidonia/geometry/se3.h>

#include <cmath>
#include <filesystem>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
const std::vector<std::string> kDvlHeader{"Time [s]", "DVL X [m/s]", "DVL Y [m/s]", "DVL Z [m/s]"};
const std::vector<std::string> kTruthHeader{
	"Time [s]",		"Longitude [rad]", "Latitude [rad]", "Altitude [m]", "V North [m/s]",
	"V East [m/s]", "V Down [m/s]",	   "Roll [rad]",	 "Pitch [rad]",	 "Yaw [rad]"};

Vector3d vectorOf(const TCsvRow& r, size_t i)
{
	return {r.number(i), r.number(i + 1), r.number(i + 2)};
}

/** Column `i` as an angle within +-`limit` [rad]: degrees in its place are found out. */
double angleOf(const TCsvRow& r, size_t i, double limit)
{
	const double angle = r.number(i);
	if (std::abs(angle) <= limit) return angle;
	throw CRowProblem(
		"column " + std::to_string(i + 1) + " (" + kTruthHeader[i] + ") '" + r.fields[i] + "' is beyond +-" +
		mrpt::format("%.4f", limit) + " rad");
}

TTruthRow truthOf(const TCsvRow& r)
{
	constexpr double kDegrees = 180 / M_PI, kHighest = 9;  // [m]: no boat, and the pressure stays > 0
	TTruthRow row;
	row.stamp = r.stamp;
	row.position = {angleOf(r, 2, M_PI / 2) * kDegrees, angleOf(r, 1, M_PI) * kDegrees, r.number(3)};
	if (row.position.height > kHighest)
		throw CRowProblem(
			"column 4 (" + kTruthHeader[3] + ") '" + r.fields[3] + "' is above the water: negative is below");
	row.velocity = vectorOf(r, 4);
	row.R_map_body =
		rotationFromYawPitchRoll(angleOf(r, 9, 2 * M_PI), angleOf(r, 8, M_PI / 2), angleOf(r, 7, 2 * M_PI));
	return row;
}

/** All rows of a table by `convert`. */
template <class ROW, class CONVERT>
std::vector<ROW> readTable(
	const std::string& path, const std::vector<std::string>& header, CBadRows& bad, CONVERT convert)
{
	CCsvReader csv(path, header, bad);
	std::vector<ROW> rows;
	while (const auto row = csv.next()) {
		try {
			rows.push_back(convert(*row));
		}
		catch (const CRowProblem& problem) {
			csv.refuse(*row, problem.what());
		}
	}
	if (rows.empty()) throw CError(path, "holds no usable row", "check its numbers");
	return rows;
}

/** Compares each ping with the row of the truth at the same time. */
void compareVelocities(const TDvlGtTables& tables, TDvlGtAgreement& a)
{
	Vector3d sum = Vector3d::Zero(), squares = sum, speeds = sum;
	auto truth = tables.truth.begin();
	for (const auto& ping : tables.dvl) {
		while (truth != tables.truth.end() && truth->stamp < ping.stamp)
			++truth;
		if (truth == tables.truth.end()) break;
		if (truth->stamp != ping.stamp) continue;
		const Vector3d v = truth->R_map_body.transpose() * truth->velocity, error = ping.velocity - v;
		sum += error;
		squares += error.cwiseAbs2();
		speeds += v.cwiseAbs2();
		a.pings++;
	}
	if (!a.pings) return;
	const double n = static_cast<double>(a.pings);
	a.dvl_mean = sum / n;
	a.dvl_rms = (squares / n).cwiseSqrt();
	a.velocity_rms = (speeds / n).cwiseSqrt();
}

/** Compares the truth's velocities with its positions. */
void comparePositions(const std::vector<TTruthRow>& truth, TDvlGtAgreement& a)
{
	if (truth.size() < 2) return;
	const TWorldOptions datum{truth[0].position.latitude, truth[0].position.longitude};
	const Vector3d start = truth[0].T_map_body(datum).translation();
	Vector3d p = start, summed = start;
	double squares = 0, vertical = 0, time = 0;
	for (size_t i = 1; i < truth.size(); i++) {
		const double dt = double(truth[i].stamp - truth[i - 1].stamp) * 1e-9;
		const Vector3d next = truth[i].T_map_body(datum).translation(),
					   velocity = (truth[i].velocity + truth[i - 1].velocity) / 2;
		summed += velocity * dt;
		a.way += (next - p).norm();
		if (dt > 0) {
			squares += std::pow((next.z() - p.z()) / dt - velocity.z(), 2) * dt;
			vertical += velocity.z() * velocity.z() * dt;
			time += dt;
		}
		p = next;
	}
	a.closure = (summed - p).norm();
	if (time > 0) a.down_rms = std::sqrt(squares / time);
	if (time > 0) a.vertical_rms = std::sqrt(vertical / time);
}
}  // namespace

Isometry3d TTruthRow::T_map_body(const TWorldOptions& datum) const
{
	Isometry3d T = Isometry3d::Identity();
	T.translation() = nedFromGeodetic(position, datum);
	T.translation().z() = -position.height;
	T.linear() = R_map_body;
	return T;
}

TDvlGtTables readDvlGtTables(const std::string& folder, CBadRows& bad)
{
	if (!std::filesystem::is_directory(folder))
		throw CError(folder, "no such folder", "give the folder that holds DVL.csv and GT.csv");
	TDvlGtTables tables;
	tables.folder = folder;
	tables.dvl = readTable<TDvlRow>(folder + "/DVL.csv", kDvlHeader, bad, [](const TCsvRow& r) {
		return TDvlRow{r.stamp, vectorOf(r, 1)};
	});
	tables.truth = readTable<TTruthRow>(folder + "/GT.csv", kTruthHeader, bad, truthOf);
	return tables;
}

TDvlGtAgreement agreementOf(const TDvlGtTables& tables)
{
	TDvlGtAgreement agreement;
	compareVelocities(tables, agreement);
	comparePositions(tables.truth, agreement);
	return agreement;
}

double TDvlGtAgreement::sigmaDvl() const
{
	constexpr double kSmallest = 0.001;	 // [m/s]: no DVL is better, and a sigma is > 0
	return std::max(dvl_rms.head<2>().norm() / M_SQRT2, kSmallest);
}

std::vector<std::string> TDvlGtAgreement::warnings() const
{
	std::vector<std::string> out;
	if (dvl_rms.norm() > 0.5 * velocity_rms.norm() + 0.01)
		out.push_back(
			"DVL.csv is not GT.csv's velocity in body axes: are the axes forward, starboard, down, and the "
			"angles those from north, east, down to them?");
	if (down_rms > 0.5 * vertical_rms + 0.01)
		out.push_back("GT.csv: its altitude does not fall as V Down says: is a sign another one?");
	return out;
}

std::vector<std::string> TDvlGtAgreement::notes() const
{
	return {
		mrpt::format(
			"DVL.csv less GT.csv's velocity in body axes, %zu pings: mean %.4f %.4f %.4f m/s, rms %.4f %.4f "
			"%.4f m/s",
			pings, dvl_mean.x(), dvl_mean.y(), dvl_mean.z(), dvl_rms.x(), dvl_rms.y(), dvl_rms.z()),
		mrpt::format(
			"GT.csv: descent by its altitude less V Down: rms %.4f m/s; its velocities, summed, end %.2f m "
			"off "
			"its position after %.1f m",
			down_rms, closure, way)};
}
}  // namespace posidonia
