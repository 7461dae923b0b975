#include <mrpt/obs/CObservationComment.h>
#include <posidonia/obs/rawlog_reader.h>

#include "mission_testing.h"

namespace fs = std::filesystem;
using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** The tiny mission by SLAM, once in a program. */
const CMissionApp& slamMission()
{
	static const CTinyMission mission;
	static CMissionApp app;
	static const bool done = [] {
		mission.fly(app, "run");
		return true;
	}();
	EXPECT_TRUE(done);
	return app;
}

double value(const CMissionApp& app, const std::string& what)
{
	return metric(app.results().metrics, what);
}
}  // namespace

TEST(MissionApp, TheVehicleArrivesAndKeepsStation)
{
	const CMissionApp& app = slamMission();
	EXPECT_TRUE(app.results().steps.back().output.finished);
	EXPECT_EQ(app.results().steps.back().output.level, ESafetyLevel::NONE);
	EXPECT_LT(value(app, "mission.end_error.mean"), 0.15);
	EXPECT_LT(value(app, "mission.cross_track.mean"), 0.1);
	EXPECT_LT(value(app, "control.ate.unaligned.mean"), 0.03);
	EXPECT_LT(value(app, "mission.duration"), 150);
	EXPECT_GT(app.results().counts.roi_edges, 0);
	EXPECT_EQ(value(app, "loops.false"), 0);
}

TEST(MissionApp, TheRunFolderHoldsEverything)
{
	const auto& r = slamMission().results();
	for (const char* name :
		 {"config.ini",		"mission.ini", "sensors.ini",	   "mission.rawlog", "mission.sensors.ini",
		  "mission.gt.tum", "control.tum", "control.csv",	   "events.csv",	 "ekf.tum",
		  "odom.tum",		"slam.tum",	   "nodes.tum",		   "graph.g2o",		 "loops.csv",
		  "metrics.json",	"timings.csv", "loop_timings.csv", "run.log",		 "trajectories.svg",
		  "error.svg"})
		EXPECT_TRUE(fs::exists(r.folder + "/" + name)) << name;
	const std::string events = fileBytes(r.folder + "/events.csv");
	EXPECT_HOLDS(events, toString(EMissionEvent::STEP_STARTED));
	EXPECT_HOLDS(events, toString(EMissionEvent::MISSION_DONE));
}

TEST(MissionApp, ItsLogReplaysToTheSameGraph)
{
	const auto& r = slamMission().results();
	const CTempFolder folder;
	CGraphSlamApp replay;
	runApp(replay, {"-c", r.folder + "/config.ini", "-r", r.rawlog, "-o", folder / "replay"});
	for (const char* name : {"graph.g2o", "nodes.tum", "loops.csv", "slam.tum", "odom.tum", "ekf.tum"})
		EXPECT_EQ(fileBytes(r.folder + "/" + name), fileBytes(folder / "replay/" + name)) << name;
}

TEST(MissionApp, TwiceTheSameBytes)
{
	const CTinyMission again;
	CMissionApp app;
	again.fly(app, "run", {"--set", "Slam.threads=1"});
	const auto &a = slamMission().results(), &b = app.results();
	for (const char* name :
		 {"graph.g2o", "control.csv", "control.tum", "mission.gt.tum", "metrics.json", "events.csv"})
		EXPECT_EQ(fileBytes(a.folder + "/" + name), fileBytes(b.folder + "/" + name)) << name;
}

TEST(MissionApp, ARunRepeatsFromItsOwnFolder)
{
	const auto& first = slamMission().results();
	const CTempFolder folder;
	CMissionApp again;
	runApp(again, {"-c", first.folder + "/config.ini", "-o", folder / "again"});
	for (const char* name : {"control.csv", "graph.g2o", "config.ini", "mission.ini"})
		EXPECT_EQ(fileBytes(first.folder + "/" + name), fileBytes(folder / "again/" + name)) << name;
}

TEST(MissionApp, TheLogHasSetPointsPosesAndEvents)
{
	const auto& r = slamMission().results();
	CRawlogReader reader(r.rawlog);
	std::map<std::string, size_t> count;
	size_t comments = 0;
	while (const auto o = reader.next()) {
		count[o->sensorLabel]++;
		comments += IS_CLASS(*o, mrpt::obs::CObservationComment);
	}
	EXPECT_EQ(count["THRUSTERS"], r.steps.size());
	EXPECT_GT(count["CONTROLLER_POSE"], r.steps.size() / 2);
	EXPECT_GT(comments, 3u);
	EXPECT_EQ(count["STEREO"], r.trajectories.slam.size());
	EXPECT_EQ(count["STEREO"], static_cast<size_t>(r.counts.nodes)) << "the camera is triggered at the nodes";
}

TEST(MissionApp, SteeringByADriftingOdometryEndsElsewhere)
{
	const CTinyMission mission("[OdometryCorruption]\ndrift_xy = 0.1\n");
	CMissionApp by_odometry, by_slam, by_truth;
	mission.fly(by_odometry, "odometry", {"--set", "ClosedLoop.pose_source=odometry"});
	mission.fly(by_slam, "slam");
	mission.fly(by_truth, "truth", {"--set", "ClosedLoop.pose_source=truth"});
	const double drifted = value(by_odometry, "mission.end_error.mean");
	EXPECT_GT(drifted, 0.3);
	EXPECT_LT(value(by_slam, "mission.end_error.mean"), drifted / 2);
	EXPECT_LT(value(by_truth, "mission.end_error.mean"), 0.12);
	EXPECT_GT(value(by_odometry, "control.ate.unaligned.max"), 0.3) << "the odometry, not SLAM, was used";
}

TEST(MissionApp, ACorrectionReachesTheControllersAfterTheLatency)
{
	const CTinyMission mission("[OdometryCorruption]\ndrift_xy = 0.1\n");
	CMissionApp early, late;
	mission.fly(early, "early", {"--set", "Slam.latency=0"});
	mission.fly(late, "late", {"--set", "Slam.latency=3"});
	const auto firstCorrection = [](const CMissionApp& app) {
		for (const auto& step : app.results().steps)
			if ((step.feedback.T_map_body.inverse() * step.T_odom_body).translation().norm() > 1e-3)
				return step.t;
		return -1.0;
	};
	ASSERT_GT(firstCorrection(early), 0);
	EXPECT_GE(firstCorrection(late), firstCorrection(early) + 2.9);
}

TEST(MissionApp, AForcedJumpIsTakenAtTheLimits)
{
	const CTinyMission mission;
	CMissionApp app;
	mission.fly(app, "run", {"--set", "ForcedCorrection.time=12", "--set", "ForcedCorrection.distance=0.5"});
	EXPECT_NEAR(value(app, "jump.distance"), 0.5, 0.05);
	EXPECT_NEAR(value(app, "jump.angle"), 5 * M_PI / 180, 0.02);
	const auto& limits = app.params.controller_pose;
	const double slowest = std::max(0.5 / limits.position_rate, 5 * M_PI / 180 / limits.rotation_rate);
	EXPECT_LT(value(app, "jump.settled_after"), slowest + 1);
	EXPECT_GT(value(app, "jump.settled_after"), 0.5 * slowest);
}

TEST(MissionApp, ADeadImuEndsInASurfacing)
{
	const CTinyMission mission("[Fault.dead]\nkind = drop_out\nlabel = IMU\ntime = 15\nduration = 1000\n");
	CMissionApp app;
	mission.fly(app, "run");
	const auto& last = app.results().steps.back();
	EXPECT_TRUE(last.output.finished);
	EXPECT_GE(last.output.level, ESafetyLevel::ABORT_AND_SURFACE);
	EXPECT_LT(last.truth.T_map_body.translation().z(), 0.3) << "it is at the surface";
	EXPECT_HOLDS(fileBytes(app.results().folder + "/events.csv"), toString(EMissionEvent::SAFETY_LEVEL));
}

TEST(MissionApp, WrongInputNamesWhatIsWrong)
{
	const auto problemOf = [](const CTinyMission& mission) {
		const std::string ini = mission.folder / "tiny.ini", out = mission.folder / "run";
		const std::vector<const char*> argv{CMissionApp::name, "-c", ini.c_str(), "-o",
											out.c_str(),	   "-v", "0"};
		try {
			CMissionApp app;
			app.initialize(static_cast<int>(argv.size()), argv.data());
			app.run();
		}
		catch (const CError& problem) {
			return std::string(problem.what());
		}
		return std::string("(no error)");
	};
	const CTinyMission deep("", "[Step.1]\nkind = dive\ndepth = 300\n");
	EXPECT_HOLDS(problemOf(deep), "Step.1");
	EXPECT_FALSE(fs::exists(deep.folder / "run")) << "nothing is begun";
	EXPECT_HOLDS(problemOf(CTinyMission("pose_source = dream\n")), "pose_source");
	EXPECT_HOLDS(problemOf(CTinyMission("", "[Step.1]\nkind = dance\n")), "dance");
	const CTinyMission nobody("[Fault.x]\nkind = drop_out\nlabel = NOBODY\ntime = 1\nduration = 1\n");
	EXPECT_HOLDS(problemOf(nobody), "NOBODY");
	EXPECT_FALSE(fs::exists(nobody.folder / "run/mission.rawlog"));
}

TEST(MissionApp, OverviewAndDepthsOnRequest)
{
	const CTinyMission mission("", "[Mission]\n[Step.1]\nkind = goto\npoints = 0 1\ndepth = 3.5\n");
	CMissionApp app;
	mission.fly(app, "run", {"--set", "Simulation.overview=true", "--set", "Simulation.save_depth=true"});
	const std::string& folder = app.results().folder;
	EXPECT_TRUE(fs::exists(folder + "/mission.overview.png"));
	size_t left = 0, depth = 0;
	for (const auto& file : fs::directory_iterator(folder + "/mission_Images")) {
		left += file.path().string().find("_left.png") != std::string::npos;
		depth += file.path().string().find("_depth.png") != std::string::npos;
	}
	EXPECT_GT(left, 0u);
	EXPECT_EQ(depth, left);
}

TEST(MissionApp, ThePapersTableSaysWhereTheVehicleTrulyEnded)
{
	const CTinyMission mission("[Report]\npaper_experiment = 2\n");
	CMissionApp app;
	mission.fly(app, "run");
	const std::string log = fileBytes(app.results().folder + "/run.log");
	EXPECT_HOLDS(log, "End (m)");
	for (const char* stage : {"stages: ", "key_frame", "rendering", "control"})
		EXPECT_HOLDS(log, stage);
	EXPECT_HOLDS(log, mrpt::format("%.3f", value(app, "mission.end_error.mean")));
}

TEST(MissionApp, AMissionOverTheEndOfTheFloorIsRefused)
{
	const CTinyMission mission("", "[Mission]\n[Step.1]\nkind = goto\npoints = 0 30\ndepth = 3.5\n");
	CMissionApp app;
	try {
		mission.fly(app, "run");
		FAIL() << "it flew";
	}
	catch (const CError& problem) {
		EXPECT_HOLDS(std::string(problem.what()), "extent");
	}
}
