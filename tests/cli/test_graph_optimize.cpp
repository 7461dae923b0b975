#include <nlohmann/json.hpp>

#include "cli_testing.h"

namespace fs = std::filesystem;
using namespace posidonia::testing;

namespace
{
constexpr const char* kApp = "auv-graph-optimize";

/** Three nodes around a triangle that does not quite close, ids 5, 7, 9. */
std::string triangle()
{
	const std::string information = " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n";
	return "VERTEX_SE3:QUAT 5 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 7 1 0 0 0 0 0 1\nVERTEX_SE3:QUAT 9 2 0 0 0 0 0 "
		   "1\n"
		   "EDGE_SE3:QUAT 5 7 1 0 0 0 0 0 1" +
		   information + "EDGE_SE3:QUAT 7 9 1 0 0 0 0 0 1" + information +
		   "EDGE_SE3:QUAT 5 9 2.3 0 0 0 0 0 1" + information;
}
}  // namespace

TEST(GraphOptimizeCli, OptimisesPrintsAndWrites)
{
	const CTempFolder folder;
	const std::string in = folder.write("in.g2o", triangle());
	const TOutcome o = runProgram(kApp, in + " -o " + (folder / "out.g2o"));
	EXPECT_EQ(o.status, 0) << o.all();
	EXPECT_EQ(o.err, "");
	for (const char* part :
		 {"in.g2o: 3 nodes, 3 edges", "solver batch", "chi2 before 0.09", "after 0.03", "converged after",
		  "stage", "optimise", "peak memory"})
		EXPECT_HOLDS(o.out, part);
	EXPECT_HOLDS(fileBytes(folder / "out.g2o"), "\nVERTEX_SE3:QUAT 9 2.");
	EXPECT_FALSE(fs::exists(folder / "out.g2o.part"));
	const TOutcome quiet = runProgram(kApp, in + " -v 0");
	EXPECT_EQ(quiet.out + quiet.err, "");
	EXPECT_EQ(quiet.status, 0);
}

TEST(GraphOptimizeCli, JsonIsOneObject)
{
	const CTempFolder folder;
	const TOutcome o = runProgram(kApp, "--json " + folder.write("in.g2o", triangle()));
	EXPECT_EQ(o.status, 0) << o.all();
	const auto json = nlohmann::json::parse(o.out);
	EXPECT_NEAR(json.at("chi2_after").get<double>(), 0.03, 1e-9);
	EXPECT_TRUE(json.at("converged").get<bool>());
}

TEST(GraphOptimizeCli, EveryStartKernelAndSolverRuns)
{
	const CTempFolder folder;
	const std::string in = folder.write("in.g2o", triangle());
	for (const char* start : {"file", "odometry", "chordal"})
		for (const char* kernel : {"none", "huber", "cauchy", "dcs", "gnc"}) {
			const std::string flags = std::string(" --init ") + start + " --robust " + kernel;
			const TOutcome o = runProgram(kApp, in + flags + " --threads 2");
			EXPECT_EQ(o.status, 0) << flags << "\n" << o.all();
			EXPECT_HOLDS(o.out, "chi2 before 0.09") << flags;
			EXPECT_HOLDS(o.out, "after 0.03") << flags;
		}
	for (const char* solver : {"incremental", "levmarq"})
		EXPECT_HOLDS(runProgram(kApp, in + " --solver " + solver).out, "after 0.03") << solver;
}

TEST(GraphOptimizeCli, NotConvergedEndsWithThree)
{
	const CTempFolder folder;
	const std::string in = folder.write("in.g2o", triangle());
	// No step reaches these limits: rounding does not allow it.
	const TOutcome o = runProgram(
		kApp, in + " --json -o " + (folder / "out.g2o") +
				  " --set GraphOptimizer.max_iterations=1 --set GraphOptimizer.min_relative_decrease=0 "
				  "--set GraphOptimizer.min_step=0 --set GraphOptimizer.min_gradient=0");
	EXPECT_EQ(o.status, 3) << o.all();
	EXPECT_HOLDS(o.err, "auv-graph-optimize: warning: ");
	EXPECT_HOLDS(o.err, "not converged");
	EXPECT_FALSE(nlohmann::json::parse(o.out).at("converged").get<bool>());
	EXPECT_TRUE(fs::exists(folder / "out.g2o"));
}

TEST(GraphOptimizeCli, BadInputIsNamedAndNothingIsWritten)
{
	const CTempFolder folder;
	const std::string out = " -o " + (folder / "out.g2o") + " --marginals " + (folder / "m.csv") +
							" --weights " + (folder / "w.csv");
	expectError(kApp, "", 2, {"IN.g2o: is missing"});
	expectError(kApp, (folder / "no.g2o") + out, 1, {"no.g2o: no such file"});
	expectError(kApp, (folder / "no.graph") + out, 1, {"no.graph: no such file"});
	expectError(
		kApp, folder.write("word.g2o", triangle() + "EDGE_SE3:QUAT 5 x\n") + out, 1, {"word.g2o:7: 'x'"});
	expectError(
		kApp, folder.write("word.graph", "VERTEX3 0 0 0 0 0 0 zero\n") + out, 1, {"word.graph:1: 'zero'"});
	expectError(kApp, folder.write("empty.g2o", "") + out, 1, {"empty.g2o: no VERTEX_SE3:QUAT line"});
	expectError(
		kApp, folder.write("apart.g2o", triangle() + "VERTEX_SE3:QUAT 11 0 0 0 0 0 0 1\n") + out, 1,
		{"apart.g2o: node 3", "order of their ids"});
	expectError(
		kApp, folder.write("in.g2o", triangle()) + " -o " + (folder / "no/out.g2o"), 1, {"no/out.g2o"});
	for (const char* flag : {"--solver magic", "--init magic", "--robust magic", "--threads many"})
		expectError(kApp, (folder / "in.g2o") + " " + flag, 2, {kApp + std::string(" --help")});
	expectError(kApp, (folder / "in.g2o") + " --threads 0", 2, {"--threads 0: is not 1 to 64"});
	for (const char* name : {"out.g2o", "out.g2o.part", "m.csv", "w.csv"})
		EXPECT_FALSE(fs::exists(folder / name)) << name;
}
