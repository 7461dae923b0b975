#include <posidonia/eval/loops_file.h>

#include "apps_testing.h"

namespace fs = std::filesystem;
using namespace posidonia;
using namespace posidonia::testing;

namespace
{
int linesWith(const std::string& text, const std::string& start)
{
	std::istringstream lines(text);
	int n = 0;
	for (std::string line; std::getline(lines, line);)
		n += line.compare(0, start.size(), start) == 0;
	return n;
}

void expectSameFiles(const std::string& a, const std::string& b, const std::vector<std::string>& names)
{
	for (const auto& name : names) {
		ASSERT_FALSE(fileBytes(a + "/" + name).empty()) << name;
		EXPECT_EQ(fileBytes(a + "/" + name), fileBytes(b + "/" + name)) << name;
	}
}
}  // namespace

TEST(GraphSlamApp, FilesHoldWhatMemoryHolds)
{
	const auto& r = slamRun().results();
	const std::string folder = r.folder + "/";
	EXPECT_EQ(static_cast<size_t>(r.counts.nodes), r.trajectories.nodes.size());
	expectSameTrajectory(folder + "nodes.tum", r.trajectories.nodes);
	expectSameTrajectory(folder + "slam.tum", r.trajectories.slam);
	expectSameTrajectory(folder + "odom.tum", r.trajectories.odom);
	expectSameTrajectory(folder + "ekf.tum", r.trajectories.ekf);

	const std::string g2o = fileBytes(folder + "graph.g2o");
	EXPECT_EQ(linesWith(g2o, "VERTEX_SE3:QUAT"), r.counts.nodes);
	int accepted = 0;
	for (const auto& row : readLoops(folder + "loops.csv"))
		accepted += row.accepted();
	EXPECT_EQ(accepted, r.counts.sequential_edges + r.counts.roi_edges);
	EXPECT_EQ(linesWith(g2o, "EDGE_SE3:QUAT"), r.counts.nodes - 1 + accepted)
		<< "odometry edges and accepted ones";

	const TMetrics rows = readMetricsJson(folder + "metrics.json");
	ASSERT_EQ(rows.size(), r.metrics.size());
	for (const auto& row : r.metrics)
		EXPECT_NEAR(metric(rows, row.what), row.value, 1e-8 * std::max(1.0, std::abs(row.value))) << row.what;
	for (const char* name :
		 {"config.ini", "sensors.ini", "timings.csv", "run.log", "trajectories.svg", "error.svg"})
		EXPECT_TRUE(fs::exists(folder + name)) << name;
}

TEST(GraphSlamApp, TheMapIsNearTheTruthAndHasLoops)
{
	const auto& r = slamRun().results();
	EXPECT_GE(r.counts.nodes, 8);
	EXPECT_GT(r.counts.sequential_edges, r.counts.nodes - 2);
	EXPECT_GT(r.counts.roi_edges, 0);
	EXPECT_LT(metric(r.metrics, "nodes.ate.unaligned.mean"), 0.03);
	EXPECT_EQ(metric(r.metrics, "loops.false"), 0);
	EXPECT_LT(r.counts.chi2, r.counts.dijkstra_chi2);
}

TEST(GraphSlamApp, StereoEdgesTakeTheDriftAway)
{
	const CTempFolder folder;
	CGraphSlamApp app;
	runApp(
		app, {"-c", survey().ini, "-r", survey().rawlog, "-o", folder / "run", "--set",
			  "OdometryCorruption.drift_xy=0.04", "--set", "OdometryCorruption.drift_z=0.013"});
	const auto& rows = app.results().metrics;
	EXPECT_GT(metric(rows, "odom.end_error.unaligned"), 0.1);
	EXPECT_LT(metric(rows, "nodes.end_error.unaligned"), 0.3 * metric(rows, "odom.end_error.unaligned"));
	EXPECT_LT(metric(rows, "ekf.end_error.unaligned"), 0.05) << "ekf.tum is the filter, before the corruptor";
}

TEST(GraphSlamApp, ThreadsDoNotChangeAByte)
{
	const CTempFolder folder;
	CGraphSlamApp app;
	runApp(app, {"-c", survey().ini, "-r", survey().rawlog, "-o", folder / "run", "--set", "Slam.threads=1"});
	expectSameFiles(
		slamRun().results().folder, folder / "run",
		{"nodes.tum", "slam.tum", "odom.tum", "ekf.tum", "loops.csv", "graph.g2o", "metrics.json"});
}

TEST(GraphSlamApp, TheTruthIsForScoringOnly)
{
	const CTempFolder folder;
	copySurvey(survey().prefix, folder / "tiny", false);
	CGraphSlamApp app;
	runApp(app, {"-c", survey().ini, "-r", folder / "tiny.rawlog", "-o", folder / "run"});
	expectSameFiles(
		slamRun().results().folder, folder / "run",
		{"nodes.tum", "slam.tum", "odom.tum", "ekf.tum", "loops.csv", "graph.g2o"});
	EXPECT_EQ(metric(app.results().metrics, "graph.nodes"), slamRun().results().counts.nodes);
	for (const auto& row : app.results().metrics)
		EXPECT_EQ(row.what.find(".ate."), std::string::npos) << row.what;
	EXPECT_FALSE(fs::exists(folder / "run/error.svg"));
}

TEST(GraphSlamApp, TruncatedLogIsUsedUpToTheLoss)
{
	const CTempFolder folder;
	copySurvey(survey().prefix, folder / "tiny");
	truncateFile(folder / "tiny.rawlog", 0.5);
	CGraphSlamApp app;
	runApp(app, {"-c", survey().ini, "-r", folder / "tiny.rawlog", "-o", folder / "run"});
	const auto &cut = app.results().trajectories.slam, &whole = slamRun().results().trajectories.slam;
	ASSERT_GT(cut.size(), 2u);
	ASSERT_LT(cut.size(), whole.size());
	for (size_t i = 0; i < cut.size(); i++)
		EXPECT_TRUE(cut[i].T.matrix() == whole[i].T.matrix()) << "causal pose " << i << " knows the future";
	EXPECT_HOLDS(fileBytes(folder / "run/run.log"), "damaged after entry");
}
