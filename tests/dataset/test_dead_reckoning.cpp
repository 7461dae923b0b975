#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/dataset/dead_reckoning.h>
#include <posidonia/eval/trajectory_io.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/observations.h>
#include <posidonia/obs/rawlog_writer.h>
#include <posidonia/obs/sensor_suite.h>

#include <cstdlib>
#include <filesystem>

#include "sample_dvl_gt.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
std::string logFolder(const std::string& name)
{
	const char* set = std::getenv("POSIDONIA_DATA");
	return (set ? set : std::string(POSIDONIA_SOURCE_DIR) + "/../shared/data") + "/auv-logs/snapir/" + name;
}

double lengthOf(const TTrajectory& trajectory)
{
	double length = 0;
	for (size_t i = 1; i < trajectory.size(); i++)
		length += (trajectory[i].T.translation() - trajectory[i - 1].T.translation()).norm();
	return length;
}

/** A rawlog of the sample's circle with mounted sensors; attitudes at `ahrs_dt`, pings at `dvl_dt` from
 * 0.1 s. */
void writeMounted(const std::string& path, double ahrs_dt, double dvl_dt, double end)
{
	Isometry3d T_body_dvl = Isometry3d::Identity(), T_body_ahrs = T_body_dvl;
	T_body_dvl.linear() = rotationFromYawPitchRoll(2.3, 0.1, 3.0);
	T_body_dvl.translation() << -1.5, 0.25, 0.5;
	T_body_ahrs.linear() = rotationFromYawPitchRoll(-1, 0.2, 0.1);
	CRawlogWriter writer(path);
	for (int i = 0; i * ahrs_dt <= end; i++)
		writer.write(*makeAhrs(
			"AHRS", i * ahrs_dt, T_body_ahrs,
			CSampleDvlGt::pose(i * ahrs_dt).linear() * T_body_ahrs.linear()));
	for (int i = 0; 0.1 + i * dvl_dt <= end + 3; i++) {	 // the last ones have no attitude
		const double t = 0.1 + i * dvl_dt;
		const Vector3d turning = CSampleDvlGt::kRate * Vector3d::UnitZ();
		const Isometry3d T = CSampleDvlGt::pose(t);
		const Vector3d over_ground =
			CSampleDvlGt::velocity(t) + turning.cross(T.linear() * T_body_dvl.translation());
		const Vector3d v = (T.linear() * T_body_dvl.linear()).transpose() * over_ground;
		CObservationDVL dvl;
		dvl.sensorLabel = "DVL";
		dvl.timestamp = stampFrom(t);
		dvl.velocity = {v.x(), v.y(), v.z()};
		dvl.velocity_valid = i % 7 != 3;
		if (!dvl.velocity_valid) dvl.velocity = {99, 99, 99};
		dvl.sensorPose = toMrpt(T_body_dvl);
		writer.write(dvl);
	}
	writer.finish();
}
}  // namespace

TEST(DeadReckoning, FollowsTheConvertedCircle)
{
	const CSampleDvlGt log(2000, 0.1);
	log.import();
	const Vector3d start = CSampleDvlGt::pose(0).translation();
	const TTrajectory dr = deadReckoning(log.folder / "dive.rawlog", start);
	ASSERT_EQ(dr.size(), 2000u);
	for (const auto& p : dr) {
		const Isometry3d T = CSampleDvlGt::pose(p.stamp);
		// The trapezoid rule's error: h^2 / 12 |a(end) - a(start)| <= 0.1^2 / 12 * 2 * 0.075
		EXPECT_LT((p.T.translation() - T.translation()).norm(), 2e-4) << "t=" << p.stamp;
		EXPECT_LT((p.T.linear() - T.linear()).norm(), 1e-9) << "t=" << p.stamp;
	}
}

TEST(DeadReckoning, HeedsMountingsLostPingsAndTimesBetweenAttitudes)
{
	const CTempFolder folder;
	writeMounted(folder / "mounted.rawlog", 0.25, 0.2, 60);
	const TTrajectory dr = deadReckoning(folder / "mounted.rawlog", CSampleDvlGt::pose(0.1).translation());
	ASSERT_EQ(dr.size(), 257u);	 // 300 pings to 59.9 s less every seventh
	EXPECT_NEAR(dr.front().stamp, 0.1, 1e-6);
	EXPECT_NEAR(dr.back().stamp, 59.9, 1e-6);
	for (const auto& p : dr) {
		const Isometry3d T = CSampleDvlGt::pose(p.stamp);
		EXPECT_LT((p.T.translation() - T.translation()).norm(), 5e-3) << "t=" << p.stamp;
		EXPECT_LT((p.T.linear() - T.linear()).norm(), 1e-6) << "t=" << p.stamp;
	}
}

TEST(DeadReckoning, LabelsThatAreNotThereAreNamed)
{
	const CSampleDvlGt log(5);
	log.import();
	const std::string rawlog = log.folder / "dive.rawlog";
	EXPECT_HOLDS(
		errorOf<CError>([&] { deadReckoning(rawlog, Vector3d::Zero(), "DVL2"); }),
		"dive.rawlog: holds no velocity labelled 'DVL2' between attitudes labelled 'AHRS'");
	EXPECT_HOLDS(errorOf<CError>([&] { deadReckoning(rawlog, Vector3d::Zero(), "DVL", "MRU"); }), "'MRU'");
}

TEST(DeadReckoning, RealLogsEndWhereTheirTablesSay)
{
	const struct
	{
		const char* name;
		double end_error, length;  ///< Summed from the tables by another program [m]
		Vector3d dvl_rms;		   ///< DVL less the truth's velocity, body axes [m/s]
		double closure;			   ///< Of the truth's own velocities [m]
	} cases[] = {
		{"Trajectory1", 4.4388, 754.196, {0.0867, 0.1770, 0.0317}, 1.43},
		{"Trajectory6", 2.0670, 819.131, {0.0230, 0.1040, 0.0253}, 4.63}};
	for (const auto& c : cases) {
		const std::string input = logFolder(c.name);
		if (!std::filesystem::is_directory(input)) GTEST_SKIP() << "no " << input << " (set POSIDONIA_DATA)";
		const CTempFolder folder;
		TDatasetOptions options;
		options.format = EDatasetFormat::DVL_GT_CSV;
		options.input = input;
		options.output = folder / "auv.rawlog";
		const TDatasetReport report = importDataset(options);
		EXPECT_EQ(report.warnings, std::vector<std::string>()) << c.name;
		const std::map<std::string, size_t> counts{
			{"AHRS", 400}, {"DVL", 400}, {"PRESSURE", 400}, {"GPS", 1}};
		EXPECT_EQ(report.observations, counts) << c.name;
		const TTrajectory truth = readTum(folder / "auv.gt.tum");
		const TTrajectory dr = deadReckoning(options.output, truth.front().T.translation());
		ASSERT_EQ(dr.size(), truth.size()) << c.name;
		const double error = (dr.back().T.translation() - truth.back().T.translation()).norm();
		std::cout << c.name << ": ends " << error << " m off after " << lengthOf(truth) << " m\n";
		EXPECT_NEAR(error, c.end_error, 0.02) << c.name;
		EXPECT_NEAR(lengthOf(truth), c.length, 0.5) << c.name;
		const TSensorSuite suite = readSensors(folder / "auv.sensors.ini");
		EXPECT_NEAR(suite.dvl.at("DVL").sigma_velocity, c.dvl_rms.head<2>().norm() * M_SQRT1_2, 1e-3)
			<< c.name;
		char closure[60];
		std::snprintf(closure, sizeof closure, "its velocities, summed, end %.2f m off", c.closure);
		EXPECT_HOLDS(report.text(), closure) << c.name;
	}
}
