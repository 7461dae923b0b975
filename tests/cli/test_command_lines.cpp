#include <map>

#include "cli_testing.h"

namespace fs = std::filesystem;
using namespace posidonia::testing;

TEST(Cli, HelpNamesTheFlagsAndTheExitStatus)
{
	const std::map<std::string, std::vector<std::string>> own{
		{"auv-sim", {"--name"}},
		{"auv-ekf", {"-r", "--rawlog", "-g", "--ground-truth", "--rate", "--assume-defaults"}},
		{"auv-graphslam",
		 {"-r", "--rawlog", "-g", "--ground-truth", "--node-decider", "--edge-deciders", "--optimizer",
		  "--list-deciders", "--assume-defaults"}},
		{"auv-mission", {"--realtime"}},
		{"auv-eval", {"-i", "--input", "-g", "--ground-truth", "--align", "--json", "--summary"}},
		{"auv-dataset2rawlog",
		 {"-i", "--input", "--format", "euroc|dvl-gt-csv", "--skip-bad", "--level", "--cubic", "--overwrite",
		  "--attitude-noise", "--attitude-bias", "--attitude-bias-time", "--seed"}},
		{"auv-graph-optimize",
		 {"IN.g2o", "--solver", "incremental", "--init", "odometry", "chordal", "--robust", "dcs", "gnc",
		  "--robust-scale", "--threads", "--weights", "--marginals", "--json", "Exit status 3"}}};
	for (const auto& app : allApps())
		for (const char* flag : {"--help", "-h"}) {
			const TOutcome o = runProgram(app, flag);
			EXPECT_EQ(o.status, 0) << app << "\n" << o.all();
			for (const char* shared :
				 {"-c", "--config", "-o", "--output-dir", "-v", "--verbosity", "--set", "--dump-config",
				  "--version", "Exit status", "Example"})
				EXPECT_HOLDS(o.out, shared) << app;
			for (const auto& name : own.at(app))
				EXPECT_HOLDS(o.out, name) << app;
			EXPECT_EQ(o.err, "") << app;
		}
	EXPECT_HOLDS(runProgram("auv-dataset2rawlog", "--help").out, "here a file, not a folder");
}

TEST(Cli, VersionSaysTheLicences)
{
	for (const auto& app : allApps()) {
		const TOutcome o = runProgram(app, "--version");
		EXPECT_EQ(o.status, 0) << app << "\n" << o.all();
		for (const char* part :
			 {"Posidonia", "stereo graph-SLAM for AUVs, on MRPT", "BSD-3-Clause", "SuiteSparse"})
			EXPECT_HOLDS(o.out, part) << app;
	}
}

TEST(Cli, WrongCommandLinesEndWithTwo)
{
	for (const auto& app : allApps()) {
		expectError(app, "--no-such-flag", 2, {"no-such-flag", app + " --help"});
		expectError(app, "-v loud", 2, {"-v", app + " --help"});
		for (const char* malformed : {"nonsense", "Simulation=3", "seed=3", ".seed=3", "Simulation.=3"})
			expectError(
				app, std::string("--dump-config --set ") + malformed, 2,
				{malformed, "write --set Section.key=value"});
	}
	expectError("auv-graphslam", "", 2, {"-r/--rawlog: is missing"});
	expectError("auv-ekf", "", 2, {"-r/--rawlog: is missing"});
	expectError("auv-mission", "", 1, {"[ClosedLoop] mission: is missing"});
	expectError("auv-eval", "", 2, {"-i/--input: is missing"});
	expectError("auv-eval", "-i " + survey().rawlog, 2, {"-g/--ground-truth: is missing"});
	expectError("auv-dataset2rawlog", "-o x.rawlog", 2, {"-i/--input: is missing"});
	expectError("auv-dataset2rawlog", "-i folder", 2, {"-o: is missing"});
	expectError(
		"auv-dataset2rawlog", "-i folder -o x.rawlog --format csv", 2, {"--format", "euroc|dvl-gt-csv"});
	expectError("auv-ekf", "-r " + survey().rawlog + " --rate 0", 2, {"--rate: must be > 0"});
	expectError("auv-ekf", "-r " + survey().rawlog + " --rate nan", 2, {"--rate"});
	expectError("auv-graphslam", "-r", 2, {"-r"});
}

TEST(Cli, DumpedConfigurationIsAFixedPoint)
{
	const CTempFolder folder;
	for (const auto& app : allApps()) {
		const TOutcome first =
			runProgram(app, "-c " + survey().ini + " --dump-config --set Ekf.gate_probability=0.97");
		ASSERT_EQ(first.status, 0) << app << "\n" << first.all();
		for (const char* part :
			 {"[Simulation]", "[Route]", "way_points = 0 0 0 2 0.5 2 0.5 0", "gate_probability = 0.97",
			  "[EdgeRegistrationDeciderParameters]", "[Sensor.STEREO]", "width = 320", "// "})
			EXPECT_HOLDS(first.out, part) << app;
		const TOutcome second =
			runProgram(app, "-c " + folder.write("dump.ini", first.out) + " --dump-config");
		EXPECT_EQ(second.status, 0) << app << "\n" << second.all();
		EXPECT_EQ(first.out, second.out) << app;
	}
}

TEST(Cli, DumpedDefaultsAreThoseWithoutAConfiguration)
{
	const CTempFolder folder;
	const TOutcome first = runProgram("auv-graphslam", "--dump-config");
	EXPECT_EQ(first.status, 0) << first.all();
	EXPECT_EQ(
		first.out, runProgram("auv-graphslam", "--dump-config -c " + folder.write("d.ini", first.out)).out);
}

TEST(Cli, ListDecidersNamesThemAll)
{
	const TOutcome o = runProgram("auv-graphslam", "--list-deciders");
	EXPECT_EQ(o.status, 0) << o.all();
	for (const char* decider :
		 {"CDistanceNRD", "CEmptyERD", "CSequentialStereoERD", "CRoiStereoERD", "CSparseGSO", "CLevMarqGSO"})
		EXPECT_HOLDS(o.out, decider);
}

TEST(Cli, QuietIsQuietAndDefaultReports)
{
	const CTempFolder folder;
	const std::string run = "-c " + survey().ini + " -r " + survey().rawlog + " -o " + (folder / "run");
	const TOutcome quiet = runProgram("auv-ekf", run + " -v 0");
	EXPECT_EQ(quiet.status, 0) << quiet.all();
	EXPECT_EQ(quiet.out + quiet.err, "");
	const TOutcome normal = runProgram("auv-ekf", run);
	EXPECT_EQ(normal.status, 0) << normal.all();
	for (const char* part : {"observations", "final sigmas", "3D error", "run folder: "})
		EXPECT_HOLDS(normal.out, part);
	EXPECT_HOLDS(normal.err, "100 %");
	EXPECT_EQ(normal.err.find('\r'), std::string::npos) << "a pipe gets plain lines";
	const TOutcome details = runProgram("auv-ekf", run + " -v 2");
	EXPECT_HOLDS(details.out, "truth: ");
}

TEST(Cli, SlamRunsEndToEndAndEvalReadsTheRun)
{
	const CTempFolder folder;
	const TOutcome slam = runProgram(
		"auv-graphslam",
		"-c " + survey().ini + " -r " + survey().rawlog + " -o " + (folder / "run") + " -e CEmptyERD -v 0");
	EXPECT_EQ(slam.status, 0) << slam.all();
	EXPECT_EQ(slam.out + slam.err, "") << "quiet";
	const TOutcome eval =
		runProgram("auv-eval", "-i " + (folder / "run") + " -g " + survey().prefix + ".gt.tum");
	EXPECT_EQ(eval.status, 0) << eval.all();
	for (const char* part : {"nodes", "slam", "odom", "ekf", "unaligned", "SE(3) aligned", "loops.accepted"})
		EXPECT_HOLDS(eval.out, part);
	const TOutcome summary = runProgram("auv-eval", "--summary -i " + (folder / "run"));
	EXPECT_EQ(summary.status, 0) << summary.all();
	EXPECT_HOLDS(summary.out, "nodes.ate.unaligned.mean");
}

TEST(Cli, WithoutOutputFolderRunsGoToRunsAndLatestPointsThere)
{
	const CTempFolder folder;
	const TOutcome o = runProgram(
		"auv-ekf", "--help >/dev/null; cd " + folder.path() + " && '" + POSIDONIA_BIN_DIR +
					   "/auv-ekf' -v 0 -c " + survey().ini + " -r " + survey().rawlog);
	ASSERT_EQ(o.status, 0) << o.all();
	const fs::path latest = folder / "runs/latest";
	ASSERT_TRUE(fs::is_symlink(latest));
	EXPECT_HOLDS(fs::read_symlink(latest).string(), "tiny-ekf");
	EXPECT_TRUE(fs::exists(latest / "ekf.tum"));
}

TEST(Cli, ReportHasNoConfiguration)
{
	const TOutcome help = runProgram("auv-report", "--help");
	EXPECT_EQ(help.status, 0) << help.all();
	for (const char* part : {"RUN", "-o", "--output-dir", "-v", "--version", "Exit status", "Example"})
		EXPECT_HOLDS(help.out, part);
	EXPECT_EQ(help.out.find("--set"), std::string::npos) << "it would have no effect";
	expectError("auv-report", "--set a.b=c", 2, {"auv-report --help"});
	expectError("auv-report", "/no/such/run", 1, {"/no/such/run/run.json", "no such file"});
}

TEST(Cli, AReportIsMadeAnewFromTheFolderAlone)
{
	const CTempFolder folder;
	const std::string run = folder / "run";
	const TOutcome slam =
		runProgram("auv-graphslam", "-c " + survey().ini + " -r " + survey().rawlog + " -o " + run);
	ASSERT_EQ(slam.status, 0) << slam.all();
	EXPECT_HOLDS(slam.out, "report: " + run + "/report.html");
	const std::string first = fileBytes(run + "/report.html");
	fs::remove(run + "/report.html");
	const TOutcome report = runProgram("auv-report", run + " -o " + (folder / "paper"));
	EXPECT_EQ(report.status, 0) << report.all();
	EXPECT_HOLDS(report.out, run + "/report.html");
	EXPECT_GT(first.size(), 500000u);
	for (const char* name :
		 {"trajectories.svg", "node-errors.svg", "exports/trajectory.kml", "exports/scene.3Dscene",
		  "exports/map.simplemap", "exports/photos.csv"})
		EXPECT_TRUE(fs::exists(folder / "paper/" + name)) << name;
	EXPECT_HOLDS(fileBytes(run + "/report.html"), "\"title\":\"tiny\"");
}

TEST(Cli, JsonIsAllThatIsPrinted)
{
	const CTempFolder folder;
	const std::string run =
		"-c " + survey().ini + " -r " + survey().rawlog + " --json -o " + (folder / "run");
	for (const char* app : {"auv-graphslam", "auv-ekf"}) {
		const TOutcome o = runProgram(app, run);
		EXPECT_EQ(o.status, 0) << o.all();
		EXPECT_EQ(o.err, "") << app;
		EXPECT_EQ(o.out, fileBytes(folder / "run/metrics.json")) << app;
	}
}
