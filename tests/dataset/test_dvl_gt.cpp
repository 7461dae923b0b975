#include <gtest/gtest.h>
#include <mrpt/obs/CObservationGPS.h>
#include <posidonia/base/error.h>
#include <posidonia/dataset/dead_reckoning.h>
#include <posidonia/eval/trajectory_io.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/CObservationPressure.h>
#include <posidonia/obs/observations.h>
#include <posidonia/obs/rawlog_reader.h>
#include <posidonia/obs/sensor_suite.h>

#include <filesystem>

#include "sample_dvl_gt.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using mrpt::obs::CObservationIMU;

namespace
{
constexpr double kDegree = M_PI / 180;

std::vector<mrpt::obs::CObservation::Ptr> observationsOf(const std::string& rawlog)
{
	CRawlogReader reader(rawlog);
	std::vector<mrpt::obs::CObservation::Ptr> all;
	while (auto o = reader.next())
		all.push_back(o);
	EXPECT_EQ(reader.damage(), "");
	return all;
}

/** Those of one label. */
template <class OBSERVATION>
std::vector<typename OBSERVATION::Ptr> labelled(const std::string& rawlog, const std::string& label)
{
	std::vector<typename OBSERVATION::Ptr> out;
	for (const auto& o : observationsOf(rawlog))
		if (o->sensorLabel == label) out.push_back(std::dynamic_pointer_cast<OBSERVATION>(o));
	return out;
}

std::vector<Matrix3d> attitudesOf(const std::string& rawlog)
{
	std::vector<Matrix3d> out;
	for (const auto& o : labelled<CObservationIMU>(rawlog, "AHRS"))
		out.push_back(*attitudeOf(*o));
	return out;
}

std::vector<std::string> outputsOf(const CTempFolder& folder)
{
	std::vector<std::string> names;
	for (const auto& file : std::filesystem::directory_iterator(folder.path()))
		if (file.path().filename() != "log") names.push_back(file.path().filename().string());
	std::sort(names.begin(), names.end());
	return names;
}

double rms(const std::vector<double>& x)
{
	double sum = 0;
	for (double v : x)
		sum += v * v;
	return std::sqrt(sum / static_cast<double>(x.size()));
}
}  // namespace

TEST(DvlGt, EverySensorArrivesInStampOrder)
{
	const CSampleDvlGt log;
	const TDatasetReport report = log.import();
	const std::map<std::string, size_t> expected{{"AHRS", 60}, {"DVL", 60}, {"PRESSURE", 60}, {"GPS", 1}};
	EXPECT_EQ(report.observations, expected);
	EXPECT_EQ(report.ground_truth_poses, 60u);
	EXPECT_EQ(report.warnings, std::vector<std::string>());
	EXPECT_EQ(report.first_stamp, 0);
	EXPECT_NEAR(report.last_stamp, 59, 1e-9);
	EXPECT_EQ(
		outputsOf(log.folder), (std::vector<std::string>{"dive.gt.tum", "dive.rawlog", "dive.sensors.ini"}));
	const auto all = observationsOf(log.folder / "dive.rawlog");
	ASSERT_EQ(all.size(), 181u);
	const char* order[] = {"AHRS", "DVL", "PRESSURE", "GPS"};  // an initial pose needs the attitude first
	for (size_t i = 0; i < 4; i++)
		EXPECT_EQ(all[i]->sensorLabel, order[i]);
	for (size_t i = 1; i < all.size(); i++) {
		EXPECT_GE(all[i]->timestamp, all[i - 1]->timestamp) << "i=" << i;
		mrpt::poses::CPose3D mount;
		all[i]->getSensorPose(mount);
		EXPECT_EQ(fromMrpt(mount).matrix(), Isometry3d::Identity().matrix()) << "i=" << i;
	}
}

TEST(DvlGt, ReadingsAreThoseOfTheTables)
{
	const CSampleDvlGt log;
	log.import();
	const std::string rawlog = log.folder / "dive.rawlog";
	const auto dvl = labelled<CObservationDVL>(rawlog, "DVL");
	const auto attitudes = attitudesOf(rawlog);
	const auto pressure = labelled<CObservationPressure>(rawlog, "PRESSURE");
	const TPressureSpec spec = readSensors(log.folder / "dive.sensors.ini").pressure.at("PRESSURE");
	for (size_t i = 0; i < 60; i++) {
		const double t = double(i);
		const Isometry3d T = CSampleDvlGt::pose(t);
		EXPECT_NEAR(stampOf(*dvl[i]), t, 1e-7);
		EXPECT_TRUE(dvl[i]->velocity_valid && dvl[i]->beam_velocities.empty() && !dvl[i]->altitude_valid);
		const Vector3d v(dvl[i]->velocity.x, dvl[i]->velocity.y, dvl[i]->velocity.z);
		EXPECT_LT((T.linear() * v - CSampleDvlGt::velocity(t)).norm(), 1e-12) << "t=" << t;
		EXPECT_LT((attitudes[i] - T.linear()).norm(), 1e-12) << "t=" << t;
		EXPECT_NEAR(spec.depth(pressure[i]->pressure), T.translation().z(), 1e-9) << "t=" << t;
	}
	const auto fix = labelled<mrpt::obs::CObservationGPS>(rawlog, "GPS").at(0);
	const auto& gga = fix->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
	EXPECT_NEAR(gga.latitude_degrees, 32.5, 1e-9);
	EXPECT_NEAR(gga.longitude_degrees, 34.75, 1e-9);
	EXPECT_EQ(gga.altitude_meters, -5);
	EXPECT_EQ(gga.fix_quality, 1);
}

TEST(DvlGt, FixesEndWithTheFirstSecond)
{
	const CSampleDvlGt log(40, 0.25);
	EXPECT_EQ(log.import().observations.at("GPS"), 4u);
}

TEST(DvlGt, TheTruthIsNorthEastDownAtTheDatum)
{
	const CSampleDvlGt log;
	const TDatasetReport report = log.import();
	EXPECT_EQ(report.datum_source, "first row");
	EXPECT_NEAR(report.datum->latitude, 32.5, 1e-9);
	EXPECT_NEAR(report.datum->longitude, 34.75, 1e-9);
	EXPECT_HOLDS(report.text(), "[World] latitude = 32.500000000, longitude = 34.750000000");
	const TTrajectory truth = readTum(log.folder / "dive.gt.tum");
	ASSERT_EQ(truth.size(), 60u);
	for (const auto& p : truth)
		EXPECT_LT((p.T.matrix() - CSampleDvlGt::pose(p.stamp).matrix()).norm(), 1e-6) << "t=" << p.stamp;

	TDatasetOptions options = log.options("elsewhere");
	const Vector3d origin(-100, 40, 0);
	const TGeodetic g = geodeticFromNed(origin, CSampleDvlGt::datum());
	options.datum = TWorldOptions{g.latitude, g.longitude};
	EXPECT_EQ(importDataset(options).datum_source, "ini");
	const Vector3d moved = readTum(log.folder / "elsewhere.gt.tum")[0].T.translation();
	EXPECT_LT((moved - Vector3d(100, -40, 5)).norm(), 1e-2);  // north turns a little with the longitude
}

TEST(DvlGt, SensorsIniStatesRatesAndWhatWasMeasured)
{
	const CSampleDvlGt log(300, 0.5);
	std::string dvl = CSampleDvlGt::kDvlHeader;
	for (int i = 0; i < 300; i++) {	 // 0.03 forward and 0.04 starboard, alternating: rms 0.05 / sqrt(2)
		const Vector3d v = CSampleDvlGt::pose(i * 0.5).linear().transpose() * CSampleDvlGt::velocity(i * 0.5);
		const double s = i % 2 ? 1 : -1;
		dvl += CSampleDvlGt::row({i * 0.5, v.x() + s * 0.03, v.y() + s * 0.04, v.z()});
	}
	log.folder.write("log/DVL.csv", dvl);
	const TDatasetReport report = log.import();
	const TSensorSuite suite = readSensors(log.folder / "dive.sensors.ini");
	EXPECT_NEAR(suite.dvl.at("DVL").sigma_velocity, 0.05 * M_SQRT1_2, 1e-9);
	EXPECT_HOLDS(report.text(), "rms 0.0300 0.0400 0.0000 m/s");
	EXPECT_NEAR(suite.dvl.at("DVL").rate, 2, 1e-6);
	EXPECT_NEAR(suite.ahrs.at("AHRS").rate, 2, 1e-6);
	EXPECT_NEAR(suite.ahrs.at("AHRS").sigma_heading, 0.1 * kDegree, 1e-12);
	EXPECT_EQ(suite.ahrs.at("AHRS").sigma_heading_bias, 0);
	EXPECT_TRUE(suite.imu.empty() && suite.stereo.empty());
}

TEST(DvlGt, WithoutPingsAtTheTruthsTimesTheSigmaIsTheDefault)
{
	const CSampleDvlGt log;
	std::string dvl = CSampleDvlGt::kDvlHeader;
	for (int i = 0; i < 50; i++)
		dvl += CSampleDvlGt::dvlRow(i + 0.5);
	log.folder.write("log/DVL.csv", dvl);
	EXPECT_HOLDS(log.import().text(), "0 pings");
	EXPECT_EQ(
		readSensors(log.folder / "dive.sensors.ini").dvl.at("DVL").sigma_velocity, TDvlSpec().sigma_velocity);
}

TEST(DvlGt, OtherSignsAndAxesAreWarnedOf)
{
	const CSampleDvlGt log;
	std::string dvl = CSampleDvlGt::kDvlHeader, truth = CSampleDvlGt::kTruthHeader;
	for (int i = 0; i < 60; i++) {
		const Vector3d v = CSampleDvlGt::pose(i).linear().transpose() * CSampleDvlGt::velocity(i);
		dvl += CSampleDvlGt::row({double(i), v.y(), v.x(), -v.z()});
		std::string row = CSampleDvlGt::truthRow(i);
		truth += row.replace(row.find(",0.1000"), 2, ",-0");  // V Down
	}
	log.folder.write("log/DVL.csv", dvl);
	EXPECT_HOLDS(log.import().text(), "warning: DVL.csv is not GT.csv's velocity in body axes");
	log.write();
	log.folder.write("log/GT.csv", truth);
	TDatasetOptions options = log.options();
	options.overwrite = true;
	EXPECT_HOLDS(importDataset(options).text(), "warning: GT.csv: its altitude does not fall as V Down says");
}

TEST(DvlGt, EachBadRowNamesFileLineAndColumnOrIsCounted)
{
	const struct
	{
		const char *file, *row, *problem;
	} cases[] = {
		{"DVL.csv", "60,1,2", "DVL.csv:62: has 3 columns, 4 were expected"},
		{"DVL.csv", "60,1,two,3", "DVL.csv:62: column 3 'two' is not a number"},
		{"DVL.csv", "60,1,nan,3", "DVL.csv:62: column 3 'nan' is not a number"},
		{"DVL.csv", "58,1,2,3", "DVL.csv:62: time stamp 58 goes backwards: the row before has 59"},
		{"DVL.csv", "-1,1,2,3", "DVL.csv:62: time '-1' is no number >= 0 [s]"},
		{"DVL.csv", "inf,1,2,3", "DVL.csv:62: time 'inf' is no number"},
		{"DVL.csv", "1e18,1,2,3", "DVL.csv:62: time '1e18' is no number"},
		{"GT.csv", "60,34.7,0.5,-5,1,1,0,0,0,0", "GT.csv:62: column 2 (Longitude [rad]) '34.7' is beyond"},
		{"GT.csv", "60,0.6,32.8,-5,1,1,0,0,0,0", "GT.csv:62: column 3 (Latitude [rad]) '32.8' is beyond"},
		{"GT.csv", "60,0.6,0.5,50,1,1,0,0,0,0", "GT.csv:62: column 4 (Altitude [m]) '50' is above the water"},
		{"GT.csv", "60,0.6,0.5,-5,x,1,0,0,0,0", "GT.csv:62: column 5 'x' is not a number"},
		{"GT.csv", "60,0.6,0.5,-5,1,1,0,9,0,0", "GT.csv:62: column 8 (Roll [rad]) '9' is beyond"},
		{"GT.csv", "60,0.6,0.5,-5,1,1,0,0,2,0", "GT.csv:62: column 9 (Pitch [rad]) '2' is beyond"},
		{"GT.csv", "60,0.6,0.5,-5,1,1,0,0,0,-170", "GT.csv:62: column 10 (Yaw [rad]) '-170' is beyond"},
	};
	for (const auto& c : cases) {
		const CSampleDvlGt log;
		const std::string path = log.folder / (std::string("log/") + c.file);
		std::ofstream(path, std::ios::app) << c.row << "\n";
		EXPECT_HOLDS(errorOf<CError>([&] { log.import(); }), c.problem) << c.row;
		EXPECT_EQ(outputsOf(log.folder), std::vector<std::string>()) << c.row;
		TDatasetOptions options = log.options();
		options.skip_bad = true;
		const TDatasetReport report = importDataset(options);
		EXPECT_EQ(report.bad_rows, 1u) << c.row;
		EXPECT_EQ(report.observations.at("DVL") + report.observations.at("AHRS"), 120u) << c.row;
		EXPECT_HOLDS(report.text(), c.problem) << c.row;
	}
}

TEST(DvlGt, FoldersFilesAndHeadersAreNamed)
{
	const CSampleDvlGt log;
	const auto problem = [&](TDatasetOptions options) {
		return errorOf<CError>([&] { importDataset(options); });
	};
	TDatasetOptions nowhere = log.options();
	nowhere.input = log.folder / "none";
	EXPECT_HOLDS(problem(nowhere), "none: no such folder; give the folder that holds DVL.csv and GT.csv");
	std::string swapped = CSampleDvlGt::kTruthHeader;
	swapped.replace(swapped.find("Longitude"), 9, "Latitude");
	log.folder.write("log/GT.csv", swapped);
	EXPECT_HOLDS(
		problem(log.options()),
		"GT.csv:1: column 2 is 'Latitude [rad]', 'Longitude [rad]' was expected; the first line must be "
		"'Time [s],Longitude [rad],");
	log.folder.write("log/GT.csv", "Time [s],Longitude [rad]\n");
	EXPECT_HOLDS(problem(log.options()), "GT.csv:1: names 2 columns, 10 were expected");
	log.folder.write("log/GT.csv", CSampleDvlGt::kTruthHeader);
	EXPECT_HOLDS(problem(log.options()), "GT.csv: holds no usable row");
	std::filesystem::remove(log.folder / "log/DVL.csv");
	EXPECT_HOLDS(problem(log.options()), "DVL.csv: no such file; it starts with the line 'Time [s],DVL X");
	log.write();
	EXPECT_EQ(problem(log.options()), "");
	EXPECT_HOLDS(problem(log.options()), "dive.rawlog: exists already");
}

TEST(DvlGt, AttitudeErrorsAreOnTheAhrsAloneAndStated)
{
	const CSampleDvlGt log;
	log.import();
	TDatasetOptions options = log.options("poor");
	options.attitude_errors = {0.5 * kDegree, 1 * kDegree, 300, 7};
	const TDatasetReport report = importDataset(options);
	EXPECT_HOLDS(report.text(), "the AHRS has errors: noise 0.500 deg, bias 1.000 deg over 300 s, seed 7");
	EXPECT_EQ(fileBytes(log.folder / "dive.gt.tum"), fileBytes(log.folder / "poor.gt.tum"));
	const TAhrsSpec ahrs = readSensors(log.folder / "poor.sensors.ini").ahrs.at("AHRS");
	for (double sigma : {ahrs.sigma_roll_pitch, ahrs.sigma_heading})
		EXPECT_NEAR(sigma, 0.5 * kDegree, 1e-12);
	for (double sigma : {ahrs.sigma_tilt_bias, ahrs.sigma_heading_bias})
		EXPECT_NEAR(sigma, 1 * kDegree, 1e-12);
	EXPECT_EQ(ahrs.bias_time, 300);
	const auto clean = attitudesOf(log.folder / "dive.rawlog"),
			   poor = attitudesOf(log.folder / "poor.rawlog");
	CAttitudeErrors errors(options.attitude_errors);
	for (size_t i = 0; i < clean.size(); i++) {
		const Matrix3d expected = errors.degraded(double(i), clean[i]);
		EXPECT_LT((poor[i] - expected).norm(), 1e-9) << "i=" << i;
		EXPECT_GT((poor[i] - clean[i]).norm(), 1e-4) << "i=" << i;
	}
	const auto dvl = labelled<CObservationDVL>(log.folder / "poor.rawlog", "DVL");
	EXPECT_EQ(dvl[9]->velocity, labelled<CObservationDVL>(log.folder / "dive.rawlog", "DVL")[9]->velocity);

	options.output = log.folder / "again.rawlog";
	importDataset(options);
	EXPECT_EQ(fileBytes(log.folder / "poor.rawlog"), fileBytes(log.folder / "again.rawlog"));
	options.output = log.folder / "other.rawlog";
	options.attitude_errors.seed = 8;
	importDataset(options);
	EXPECT_NE(fileBytes(log.folder / "poor.rawlog"), fileBytes(log.folder / "other.rawlog"));
}

TEST(AttitudeErrors, NoiseIsWhiteOnRollPitchAndHeading)
{
	const Vector3d ypr(1.2, 0.3, -0.2);
	const Matrix3d R = rotationFromYawPitchRoll(ypr[0], ypr[1], ypr[2]);
	CAttitudeErrors errors({0.01, 0, 600, 3});
	constexpr int kRows = 4000;
	std::vector<double> e[3], product[3];
	Vector3d before = Vector3d::Zero();
	for (int i = 0; i < kRows; i++) {
		const Vector3d now = yawPitchRoll(errors.degraded(i, R)) - ypr;
		for (int k = 0; k < 3; k++) {
			e[k].push_back(now[k]);
			product[k].push_back(now[k] * before[k]);
		}
		before = now;
	}
	for (int k = 0; k < 3; k++) {  // 4 sigma of the statistic
		EXPECT_NEAR(rms(e[k]), 0.01, 0.01 * 4 / std::sqrt(2.0 * kRows)) << "angle " << k;
		double lagged = 0;
		for (double p : product[k])
			lagged += p / kRows;
		EXPECT_NEAR(lagged, 0, 1e-4 * 4 / std::sqrt(kRows)) << "angle " << k;
	}
}

TEST(AttitudeErrors, BiasIsAStationaryGaussMarkovProcessAboutMapAxes)
{
	constexpr int kSeeds = 3000;
	constexpr double kSigma = 0.02;
	const Matrix3d R = rotationFromYawPitchRoll(1.2, 0.3, -0.2);
	Vector3d first = Vector3d::Zero(), last = first, product = first;
	for (unsigned seed = 0; seed < kSeeds; seed++) {
		CAttitudeErrors errors({0, kSigma, 600, seed});
		const Vector3d b0 = logSO3(errors.degraded(50, R) * R.transpose());
		errors.degraded(400, R);
		const Vector3d b1 = logSO3(errors.degraded(650, R) * R.transpose());
		EXPECT_LT((b1 - errors.bias()).norm(), 1e-12) << "seed " << seed;
		first += b0.cwiseAbs2() / kSeeds;
		last += b1.cwiseAbs2() / kSeeds;
		product += b0.cwiseProduct(b1) / kSeeds;
	}
	const double band = kSigma * kSigma * 4 * std::sqrt(2.0 / kSeeds);
	for (int k = 0; k < 3; k++) {
		EXPECT_NEAR(first[k], kSigma * kSigma, band) << "axis " << k;
		EXPECT_NEAR(last[k], kSigma * kSigma, band) << "axis " << k;
		EXPECT_NEAR(product[k], kSigma * kSigma * std::exp(-1), band) << "axis " << k;
	}
}

TEST(AttitudeErrors, NoiseStaysTheSameWhenTheBiasIsSwitchedOff)
{
	const Matrix3d R = rotationFromYawPitchRoll(1.2, 0.3, -0.2);
	CAttitudeErrors none({0, 0, 600, 5}), noise({0.01, 0, 600, 5}), both({0.01, 0.02, 600, 5});
	for (int i = 0; i < 20; i++) {
		EXPECT_EQ(none.degraded(i, R), R);
		const Matrix3d with_noise = noise.degraded(i, R), with_both = both.degraded(i, R);
		EXPECT_LT((expSO3(both.bias()) * with_noise - with_both).norm(), 1e-12) << "i=" << i;
	}
}
