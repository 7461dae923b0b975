#include <posidonia/obs/observations.h>
#include <posidonia/obs/rawlog_reader.h>

#include "cli_testing.h"

namespace fs = std::filesystem;
using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** Arguments of a run over `rawlog` into `folder`/run. */
std::string runOf(const std::string& rawlog, const CTempFolder& folder)
{
	return "-c " + survey().ini + " -r " + rawlog + " -o " + (folder / "run");
}

/** Left picture of the n-th stereo pair. */
std::string leftPicture(const std::string& rawlog, int n)
{
	CRawlogReader reader(rawlog);
	while (const auto o = reader.next())
		if (const auto* pair = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(o.get());
			pair && n-- == 0)
			return pair->imageLeft.getExternalStorageFile();
	return {};
}
}  // namespace

TEST(CliErrors, AMissingFileIsNamed)
{
	const CTempFolder folder;
	for (const char* app : {"auv-graphslam", "auv-ekf"}) {
		expectError(app, "-r " + (folder / "no.rawlog"), 1, {"no.rawlog: no such file", "-r/--rawlog"});
		expectError(app, "-r " + folder.path(), 1, {"is a folder"});
		expectError(
			app, "-r " + survey().rawlog + " -g " + (folder / "no.tum"), 1,
			{"no.tum: no such file", "-g/--ground-truth"});
		EXPECT_FALSE(fs::exists(folder / "run"));
	}
	for (const auto& app : allApps())
		expectError(
			app, "--dump-config -c " + (folder / "no.ini"), 1, {"no.ini: no such file", "-c/--config"});
	expectError("auv-sim", "-o " + folder.path() + " --set Floor.image=no.jpg", 1, {"no.jpg"});
	expectError(
		"auv-dataset2rawlog", "-i " + (folder / "no") + " -o " + (folder / "x.rawlog"), 1,
		{"no: no such folder"});
	expectError(
		"auv-dataset2rawlog", "-i " + folder.path() + " -o " + (folder / "x.log"), 1,
		{"x.log: must end in .rawlog"});
	expectError(
		"auv-dataset2rawlog", "--format dvl-gt-csv -i " + folder.path() + " -o " + (folder / "x.rawlog"), 1,
		{"DVL.csv: no such file"});
	expectError(
		"auv-eval", "-i " + (folder / "no") + " -g " + survey().prefix + ".gt.tum", 1,
		{"no: no such file or folder"});
}

TEST(CliErrors, AFileThatIsNoRawlogIsNamed)
{
	const CTempFolder folder;
	const std::string fake = folder.write("fake.rawlog", "this is no rawlog at all, only text");
	fs::copy(survey().prefix + ".sensors.ini", folder / "fake.sensors.ini");
	for (const char* app : {"auv-graphslam", "auv-ekf"})
		expectError(app, runOf(fake, folder), 1, {"fake.rawlog: "});
	EXPECT_FALSE(fs::exists(folder / "run/nodes.tum"));
	EXPECT_FALSE(fs::exists(folder / "run/ekf.tum"));
}

TEST(CliErrors, AMisspeltKeyIsNamedWithASuggestion)
{
	const CTempFolder folder;
	const std::string key = folder.write("key.ini", "[NodeRegistrationDeciderParameters]\ndistanse = 1\n");
	const std::string section =
		folder.write("section.ini", "[NodeRegistrationDeciderParameter]\ndistance = 1\n");
	const std::string twice = folder.write("twice.ini", "[Ekf]\nuse_gps = true\nuse_gps = false\n");
	for (const auto& app : allApps()) {
		expectError(
			app, "--dump-config -c " + key, 1,
			{"key.ini", "[NodeRegistrationDeciderParameters]", "'distanse'", "did you mean 'distance'?"});
		expectError(
			app, "--dump-config -c " + section, 1,
			{"section.ini", "did you mean", "NodeRegistrationDeciderParameters"});
		expectError(app, "--dump-config -c " + twice, 1, {"twice.ini:3", "given twice"});
		expectError(
			app, "--dump-config --set Ekf.use_gsp=true", 1,
			{"[Ekf]", "'use_gsp'", "did you mean 'use_gps'?"});
	}
}

TEST(CliErrors, ABadValueIsNamedWithItsRange)
{
	const CTempFolder folder;
	const std::string ini = folder.write("range.ini", "[Slam]\nthreads = 0\n");
	for (const auto& app : allApps()) {
		expectError(
			app, "--dump-config -c " + ini, 1, {"range.ini", "[Slam] threads = 0", "must be in [1, 64]"});
		expectError(
			app, "--dump-config --set Slam.threads=two", 1, {"[Slam] threads = two", "is not a number"});
		expectError(app, "--dump-config --set Slam.threads=1.5", 1, {"[Slam] threads = 1.5", "whole number"});
		expectError(app, "--dump-config --set Odometry.source=efk", 1, {"[Odometry] source = efk", "ekf"});
		expectError(app, "--dump-config --set Ekf.use_gps=yes", 1, {"[Ekf] use_gps = yes", "true or false"});
	}
}

TEST(CliErrors, AnUnknownDeciderListsTheKnownOnes)
{
	const CTempFolder folder;
	const std::string run = runOf(survey().rawlog, folder);
	expectError("auv-graphslam", run + " -n CFixedNRD", 1, {"CFixedNRD", "CDistanceNRD"});
	expectError("auv-graphslam", run + " -e 'CSequentialStereoERD CRoiERD'", 1, {"CRoiERD", "CRoiStereoERD"});
	expectError("auv-graphslam", run + " --optimizer CGtsamGSO", 1, {"CGtsamGSO", "CSparseGSO"});
	expectError(
		"auv-graphslam", run + " --set Slam.node_decider=CFixedNRD", 1, {"CFixedNRD", "CDistanceNRD"});
	EXPECT_FALSE(fs::exists(folder / "run/nodes.tum"));
}

TEST(CliErrors, AMissingPictureIsNamedAndNothingHalfIsWritten)
{
	const CTempFolder folder;
	copySurvey(survey().prefix, folder / "dive");
	const std::string picture = leftPicture(folder / "dive.rawlog", 2);
	ASSERT_TRUE(fs::remove(folder / ("dive_Images/" + picture)));
	expectError(
		"auv-graphslam", runOf(folder / "dive.rawlog", folder), 1,
		{"dive.rawlog", picture, "dive_Images/", "left"});
	for (const char* name :
		 {"nodes.tum", "nodes.tum.part", "slam.tum", "graph.g2o", "loops.csv", "metrics.json"})
		EXPECT_FALSE(fs::exists(folder / (std::string("run/") + name))) << name;
	const TOutcome ekf = runProgram("auv-ekf", runOf(folder / "dive.rawlog", folder));
	EXPECT_EQ(ekf.status, 0) << "the filter needs no picture\n" << ekf.all();
}

TEST(CliErrors, AMissingSensorsFileIsAnErrorUnlessDefaultsAreAssumed)
{
	const CTempFolder folder;
	copySurvey(survey().prefix, folder / "dive");
	fs::remove(folder / "dive.sensors.ini");
	const std::string run = runOf(folder / "dive.rawlog", folder);
	for (const char* app : {"auv-graphslam", "auv-ekf"}) {
		expectError(app, run, 1, {"dive.sensors.ini", "--assume-defaults"});
		const std::string deciders = app == std::string("auv-graphslam") ? " -e CEmptyERD" : "";
		const TOutcome o = runProgram(app, run + " --assume-defaults" + deciders);
		EXPECT_EQ(o.status, 0) << app << "\n" << o.all();
	}
}

TEST(CliErrors, ATruncatedLogIsUsedAndTheLossIsSaid)
{
	const CTempFolder folder;
	copySurvey(survey().prefix, folder / "dive");
	truncateFile(folder / "dive.rawlog", 0.5);
	const std::string run = runOf(folder / "dive.rawlog", folder);
	for (const std::string app : {"auv-ekf", "auv-graphslam -e CEmptyERD"})
		for (const char* verbosity : {"0", "1"}) {
			const TOutcome o = runProgram(
				app.substr(0, app.find(' ')),
				run + (app.find(' ') == std::string::npos ? "" : app.substr(app.find(' '))) + " -v " +
					verbosity);
			EXPECT_EQ(o.status, 0) << app << "\n" << o.all();
			EXPECT_HOLDS(o.out, "warning: " + (folder / "dive.rawlog") + ": damaged after entry");
		}
	EXPECT_GT(fs::file_size(folder / "run/nodes.tum"), 0u);
	EXPECT_GT(fs::file_size(folder / "run/ekf.tum"), 0u);
}

TEST(CliErrors, ALogWhoseOdometryNeverStartsIsAnError)
{
	const CTempFolder folder;
	const TOutcome sim = runProgram(
		"auv-sim", "-v 0 -c " + survey().ini + " -o " + folder.path() +
					   " --name dry --set Simulation.duration=5 --set Simulation.imu=false");
	ASSERT_EQ(sim.status, 0) << sim.all();
	for (const char* app : {"auv-graphslam", "auv-ekf"})
		expectError(app, runOf(folder / "dry.rawlog", folder), 1, {});
	EXPECT_FALSE(fs::exists(folder / "run/dry-ekf.rawlog"));
	EXPECT_FALSE(fs::exists(folder / "run/dry-ekf.rawlog.part"));
}

TEST(CliErrors, ARunFolderThatCantBeMadeIsNamed)
{
	const CTempFolder folder;
	const std::string file = folder.write("file", "");
	expectError(
		"auv-ekf", "-r " + survey().rawlog + " -o " + file + "/run", 1,
		{file + "/run", "can't make this folder"});
}

/** Ctrl-C in the middle: what was run is scored and written, and the folder says that it is not all. */
TEST(CliErrors, AnInterruptedRunLeavesAWholeFolder)
{
	const CTempFolder folder;
	const std::string run = folder / "run",
					  ini = std::string(POSIDONIA_SOURCE_DIR) + "/ini/paper-exp2-closed.ini";
	// The simulator's first two minutes are some seconds of the clock; Ctrl-C comes when the log has begun.
	const std::string command =
		std::string("'") + POSIDONIA_BIN_DIR + "/auv-mission' -c " + ini + " -o " + run + " > " +
		(folder / "out") + " 2>&1 & pid=$!; for i in $(seq 600); do ls " + run +
		"/loops/000010.jpg > /dev/null 2>&1 && break; sleep 0.1; done; kill -INT $pid; wait $pid";
	const int raw = std::system(command.c_str());
	ASSERT_TRUE(WIFEXITED(raw));
	EXPECT_EQ(WEXITSTATUS(raw), 130) << fileBytes(folder / "out");
	EXPECT_HOLDS(fileBytes(run + "/run.log"), "INTERRUPTED");
	EXPECT_HOLDS(fileBytes(run + "/run.json"), "\"interrupted\": true");
	for (const char* name : {"mission.rawlog", "metrics.json", "nodes.tum", "graph.g2o", "report.html"})
		EXPECT_TRUE(fs::exists(run + "/" + name)) << name;
	for (const auto& file : fs::recursive_directory_iterator(run))
		EXPECT_NE(file.path().extension(), ".part") << file.path() << " is half written";
	EXPECT_EQ(
		runProgram(
			"auv-graphslam",
			"-v 0 -c " + run + "/config.ini -r " + run + "/mission.rawlog -o " + (folder / "replay"))
			.status,
		0)
		<< "its log replays";
}

TEST(CliErrors, AFilterThatBreaksSaysSoAtOnce)
{
	const CTempFolder folder;
	const std::string source = POSIDONIA_SOURCE_DIR;
	for (const char* sensor : {"AHRS", "IMU"})
		expectError(
			"auv-ekf",
			"-v 0 -c " + source + "/ini/square.ini -r " + source + "/rawlogs/square/square.rawlog -o " +
				(folder / "run") + " --set 'Sensor." + sensor + ".pose=0 0 0 0 0 180'",
			1, {"navigation filter", "no number any more", "upside down"});
}
