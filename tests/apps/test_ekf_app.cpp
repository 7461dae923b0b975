#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/serialization/CArchive.h>
#include <posidonia/apps/CEkfApp.h>
#include <posidonia/geometry/mrpt_pose.h>

#include "apps_testing.h"

namespace fs = std::filesystem;
using namespace posidonia;
using namespace posidonia::testing;

namespace
{
std::string bytesOf(const mrpt::obs::CObservation& o)
{
	mrpt::io::CMemoryStream memory;
	auto archive = mrpt::serialization::archiveFrom(memory);
	archive << o;
	return {static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount()};
}

struct TSplitLog
{
	std::vector<std::string> others;  ///< Serialised, in order
	std::vector<mrpt::obs::CObservationRobotPose::Ptr> poses;
	std::vector<double> stamp_before_pose;	///< Of the observation before each pose
};
TSplitLog split(const std::string& rawlog)
{
	TSplitLog log;
	CRawlogReader reader(rawlog);
	double last = 0;
	while (const auto o = reader.next()) {
		if (const auto pose = std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(o)) {
			log.poses.push_back(pose);
			log.stamp_before_pose.push_back(last);
			continue;
		}
		log.others.push_back(bytesOf(*o));
		last = stampOf(*o);
	}
	return log;
}

/** Runs auv-ekf on the tiny survey into `folder`/ekf. */
CEkfApp::TResults runEkf(
	const CTempFolder& folder, std::vector<std::string> more = {}, std::string rawlog = survey().rawlog)
{
	CEkfApp app;
	more.insert(more.begin(), {"-c", survey().ini, "-r", rawlog, "-o", folder / "ekf"});
	runApp(app, more);
	return app.results();
}
}  // namespace

TEST(EkfApp, TrajectoryIsNearTheTruthAndInTheFile)
{
	const CTempFolder folder;
	const auto r = runEkf(folder);
	expectSameTrajectory(folder / "ekf/ekf.tum", r.ekf);
	EXPECT_LT(metric(r.metrics, "ekf.ate.unaligned.max"), 0.1);
	EXPECT_NEAR(metric(r.metrics, "navigation.way"), survey().summary.path_length, 0.3);
	EXPECT_GT(metric(r.metrics, "navigation.sigma_north"), 0.02);
	EXPECT_LT(metric(r.metrics, "navigation.sigma_north"), 0.2);
	EXPECT_EQ(
		metric(readMetricsJson(folder / "ekf/metrics.json"), "ekf.poses"), static_cast<double>(r.ekf.size()));
	const std::string log = fileBytes(folder / "ekf/run.log");
	for (const char* part :
		 {"final sigmas: north", "DVL: used", "PRESSURE: used", "x real time", "ekf, 3D error: mean"})
		EXPECT_HOLDS(log, part);
	EXPECT_TRUE(fs::exists(folder / "ekf/config.ini"));
}

TEST(EkfApp, SmoothedPosesAreInTheirFileAndScored)
{
	const CTempFolder folder;
	const auto r = runEkf(folder, {"--smooth", "--rate", "5"});
	expectSameTrajectory(folder / "ekf/smoothed.tum", r.smoothed);
	EXPECT_NEAR(static_cast<double>(r.smoothed.size()), static_cast<double>(r.ekf.size()), 3);
	EXPECT_LT(metric(r.metrics, "smoothed.ate.unaligned.max"), 0.1);
	EXPECT_HOLDS(fileBytes(folder / "ekf/run.log"), "smoothed, 3D error: mean");
	CEkfApp app;
	EXPECT_THROW(
		runApp(
			app, {"-c", survey().ini, "-r", survey().rawlog, "--smooth", "--set", "Ekf.mode=cola2", "-o",
				  folder / "c"}),
		CUsageError);
}

TEST(EkfApp, EveryModeFollowsTheVehicle)
{
	const CTempFolder folder;
	// Without a gyro, the DVL's lever arm makes motion of turns on the spot.
	const std::pair<const char*, double> modes[] = {
		{"ins", 0.1}, {"gyro", 0.2}, {"kinematic", 1.0}, {"cola2", 0.2}};
	for (const auto& [mode, metres] : modes) {
		const auto r = runEkf(folder, {"--set", std::string("Ekf.mode=") + mode});
		EXPECT_LT(metric(r.metrics, "ekf.ate.unaligned.max"), metres) << mode;
		EXPECT_NEAR(metric(r.metrics, "navigation.way"), survey().summary.path_length, 0.3 + metres) << mode;
	}
}

TEST(EkfApp, RateLimitsThePoses)
{
	const CTempFolder folder;
	for (const double rate : {10.0, 2.0}) {
		const auto ekf = runEkf(folder, {"--rate", std::to_string(rate)}).ekf;
		const double duration = ekf.back().stamp - ekf.front().stamp;
		EXPECT_NEAR(static_cast<double>(ekf.size()), duration * rate, 0.05 * duration * rate + 2)
			<< rate << " Hz";
		for (size_t i = 1; i < ekf.size(); i++)
			EXPECT_GT(ekf[i].stamp - ekf[i - 1].stamp, 0.998 / rate) << rate << " Hz, pose " << i;
	}
}

TEST(EkfApp, NewRawlogIsTheOldOnePlusPosesInOrderOfArrival)
{
	const CTempFolder folder;
	const auto r = runEkf(folder);
	const TSplitLog before = split(survey().rawlog), after = split(r.rawlog);
	EXPECT_TRUE(before.poses.empty());
	ASSERT_EQ(after.others.size(), before.others.size());
	EXPECT_TRUE(after.others == before.others) << "an observation was changed";
	ASSERT_EQ(after.poses.size(), r.ekf.size());
	for (size_t i = 0; i < after.poses.size(); i++) {
		const auto& pose = *after.poses[i];
		EXPECT_EQ(pose.sensorLabel, "EKF");
		EXPECT_NEAR(stampOf(pose), r.ekf[i].stamp, 1e-6) << i;
		EXPECT_LE(stampOf(pose), after.stamp_before_pose[i] + 1e-6)
			<< "pose " << i << " came before its measurement";
		EXPECT_LT((fromMrpt(pose.pose.mean).matrix() - r.ekf[i].T.matrix()).norm(), 1e-9) << i;
		EXPECT_GT(pose.pose.cov(0, 0), 0) << i;
	}
	const Matrix6d last = localCovariance(after.poses.back()->pose);
	EXPECT_LT((last - r.last.cov).norm(), 0.2 * r.last.cov.norm())
		<< "the last pose is at most 0.1 s before the end";
}

TEST(EkfApp, NewRawlogReplaysWithItsPicturesByLink)
{
	const CTempFolder folder;
	const auto r = runEkf(folder);
	const fs::path link = folder / "ekf/tiny-ekf_Images";
	ASSERT_TRUE(fs::is_symlink(link));
	EXPECT_TRUE(fs::read_symlink(link).is_relative());
	CGraphSlamApp app;
	runApp(
		app, {"-c", survey().ini, "-r", r.rawlog, "-o", folder / "run", "--set", "Odometry.source=recorded",
			  "--set", "RecordedOdometry.label=EKF", "-g", survey().truth});
	EXPECT_EQ(app.results().counts.nodes, slamRun().results().counts.nodes);
	EXPECT_LT(metric(app.results().metrics, "odom.ate.unaligned.mean"), 0.05);
	EXPECT_GT(app.results().counts.sequential_edges, 0);
	runEkf(folder);	 // again into the same folder: the link is replaced
	EXPECT_TRUE(fs::is_symlink(link));
}

TEST(EkfApp, TheDriftOfTheIniIsLeftOut)
{
	const CTempFolder folder;
	runEkf(folder);
	const std::string clean = fileBytes(folder / "ekf/ekf.tum");
	runEkf(folder, {"--set", "OdometryCorruption.drift_xy=0.1"});
	EXPECT_TRUE(clean == fileBytes(folder / "ekf/ekf.tum"));
	runEkf(folder, {"--set", "Ekf.sigma_initial_velocity=0.1"});
	EXPECT_TRUE(clean != fileBytes(folder / "ekf/ekf.tum")) << "the filter's own options count";
}

TEST(EkfApp, WorksWithoutTruthAndOnATruncatedLog)
{
	const CTempFolder folder;
	copySurvey(survey().prefix, folder / "tiny", false);
	const auto whole = runEkf(folder, {}, folder / "tiny.rawlog");
	for (const auto& row : whole.metrics)
		EXPECT_EQ(row.what.find("ekf."), std::string::npos) << row.what;
	truncateFile(folder / "tiny.rawlog", 0.6);
	const auto cut = runEkf(folder, {}, folder / "tiny.rawlog");
	EXPECT_LT(cut.ekf.size(), whole.ekf.size());
	EXPECT_GT(cut.ekf.size(), whole.ekf.size() / 3);
	EXPECT_HOLDS(fileBytes(folder / "ekf/run.log"), "damaged after entry");
}

TEST(EkfApp, RefusesALogThatHoldsItsPosesAlready)
{
	const CTempFolder folder;
	const auto r = runEkf(folder);
	const std::string error = errorOf<CError>([&] {
		CEkfApp app;
		runApp(app, {"-c", survey().ini, "-r", r.rawlog, "-o", folder / "again"});
	});
	EXPECT_HOLDS(error, "tiny-ekf.rawlog: holds poses labelled EKF already");
	EXPECT_HOLDS(error, "rawlog-edit");
	EXPECT_FALSE(fs::exists(folder / "again/tiny-ekf-ekf.rawlog"));
	EXPECT_FALSE(fs::exists(folder / "again/tiny-ekf-ekf.rawlog.part"));
	EXPECT_FALSE(fs::exists(folder / "again/ekf.tum"));
}
