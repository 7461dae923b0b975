// The shipped ini files and the shipped log, as a new user meets them.
#include "apps_testing.h"

#include <posidonia/eval/metrics.h>

namespace fs = std::filesystem;
using namespace posidonia;
using namespace posidonia::testing;

namespace
{
const std::string kSource = POSIDONIA_SOURCE_DIR;
const std::string kIni = kSource + "/ini/square.ini";
const std::string kLog = kSource + "/rawlogs/square/square.rawlog";
}  // namespace

TEST(ShippedSet, GraphSlamTakesTheDriftAway)
{
	CTempFolder folder;
	CGraphSlamApp app;
	runApp(app, {"-c", kIni, "-r", kLog, "-o", folder / "run"});
	const auto& results = app.results();
	EXPECT_GT(results.counts.roi_edges, 100);
	EXPECT_LT(results.counts.chi2, results.counts.dijkstra_chi2 / 10);
	EXPECT_GT(metric(results.metrics, "odom.ate.unaligned.mean"), 0.08);
	EXPECT_LT(metric(results.metrics, "nodes.ate.unaligned.mean"), 0.01);
	EXPECT_LT(metric(results.metrics, "slam.ate.unaligned.mean"), 0.015);
	EXPECT_EQ(metric(results.metrics, "loops.false"), 0);
	EXPECT_EQ(metric(results.metrics, "loops.sequential.false"), 0);
	EXPECT_GE(metric(results.metrics, "loops.recall_of_tried"), 0.9);
	for (const char* file : {"trajectories.svg", "error.svg", "timings.csv", "run.log", "config.ini"})
		EXPECT_TRUE(fs::exists(folder / (std::string("run/") + file))) << file;
}

TEST(ShippedSet, TheSimulatorMakesTheShippedLogAgain)
{
	CTempFolder folder;
	CSimApp app;
	runApp(app, {"-c", kIni, "-o", folder / "data", "--name", "square"});
	for (const auto& entry : fs::directory_iterator(kSource + "/rawlogs/square/square_Images")) {
		const std::string name = entry.path().filename().string();
		EXPECT_TRUE(fs::exists(folder / ("data/square_Images/" + name))) << name;
	}
	const TTrajectory shipped = readTum(kSource + "/rawlogs/square/square.gt.tum");
	const TTrajectory made = readTum(folder / "data/square.gt.tum");
	ASSERT_EQ(shipped.size(), made.size());
	for (size_t k = 0; k < made.size(); k++)
		ASSERT_LT((shipped[k].T.matrix() - made[k].T.matrix()).norm(), 1e-6) << "pose " << k;
}

TEST(ShippedSet, EveryShippedIniLoads)
{
	int files = 0;
	for (const auto& entry : fs::directory_iterator(kSource + "/ini")) {
		if (entry.path().extension() != ".ini") continue;
		files++;
		CIniFile ini = CIniFile::fromFile(entry.path().string());
		TSensorSuite sensors = TSensorSuite::sparus2();
		EXPECT_NO_THROW(TExperiment::load(ini, sensors)) << entry.path();
	}
	EXPECT_GE(files, 5);
}
