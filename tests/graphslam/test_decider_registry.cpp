// Deciders and optimisers by name.
#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/base/ini_file.h>
#include <posidonia/graphslam/CSparseGSO.h>
#include <posidonia/graphslam/decider_registry.h>
#include <posidonia/posegraph/chi2.h>

#include <temp_folder.h>

#include "survey.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
std::string errorOfSetup(const TSetup& setup)
{
	return errorOf<CError>([&] { run(setup); });
}

/** The slam sections as an ini file, as the app hands it to MRPT's engine. */
std::string iniFileOf(const CTempFolder& folder, const std::string& override_key)
{
	CIniFile ini = CIniFile::fromText("");
	ini.set(override_key);
	TStereoSlamOptions options;
	options.forEachSection([&](const char* name, auto& section) { ini.loadOnto(section, name); });
	return folder.write("config.ini", ini.dump());
}
}  // namespace

TEST(DeciderRegistry, unknownNamesAreErrorsWithTheKnownOnes)
{
	TSetup setup;
	setup.stop_at_nodes = 0;
	setup.slam.slam.node_decider = "CDistanceNDR";
	EXPECT_HOLDS(errorOfSetup(setup), "CDistanceNDR");
	EXPECT_HOLDS(errorOfSetup(setup), "CDistanceNRD");

	setup = {};
	setup.slam.slam.edge_deciders = "CSequentialStereoERD CRoiStereoEDR";
	const std::string edge_error = errorOfSetup(setup);
	EXPECT_HOLDS(edge_error, "edge decider 'CRoiStereoEDR'");
	EXPECT_HOLDS(edge_error, "CRoiStereoERD");

	setup = {};
	setup.slam.slam.optimizer = "CEmptyGSO";
	const std::string optimizer_error = errorOfSetup(setup);
	EXPECT_HOLDS(optimizer_error, "optimizer 'CEmptyGSO'");
	EXPECT_HOLDS(optimizer_error, "CSparseGSO");

	setup = {};
	setup.slam.slam.edge_deciders = " , ";
	EXPECT_HOLDS(errorOfSetup(setup), "CEmptyERD");

	setup = {};
	setup.slam.slam.edge_deciders = "CRoiStereoERD CSequentialStereoERD CRoiStereoERD";
	EXPECT_HOLDS(errorOfSetup(setup), "CRoiStereoERD is named twice");
}

TEST(DeciderRegistry, listsEveryName)
{
	const std::string text = listDeciders();
	for (const char* name :
		 {"CDistanceNRD", "CEmptyERD", "CSequentialStereoERD", "CRoiStereoERD", "CSparseGSO", "CLevMarqGSO"})
	{
		EXPECT_HOLDS(text, std::string(name) + ": ");
		EXPECT_EQ(text.find(name), text.rfind(name)) << name << " twice";
	}
}

TEST(DeciderRegistry, blanksAndCommasSeparate)
{
	TSetup setup = secondExperiment();
	setup.stop_at_nodes = 9;
	setup.slam.slam.edge_deciders = "CSequentialStereoERD CRoiStereoERD";
	const auto blank = run(setup);
	setup.slam.slam.edge_deciders = "CSequentialStereoERD,CRoiStereoERD";
	const auto comma = run(setup);
	setup.slam.slam.edge_deciders = "CSequentialStereoERD";
	const auto sequential = run(setup);
	EXPECT_TRUE(fingerprint(*blank) == fingerprint(*comma));
	EXPECT_GT(edgesOf(*comma, EEdgeKind::ROI), 0);
	EXPECT_GT(edgesOf(*sequential, EEdgeKind::SEQUENTIAL), 0);
	EXPECT_EQ(edgesOf(*sequential, EEdgeKind::ROI), 0);
}

TEST(DeciderRegistry, emptyErdIsOdometryAlone)
{
	TSetup setup = secondExperiment();
	setup.slam.slam.edge_deciders = "CEmptyERD";
	const auto slam = run(setup);
	const CSlamMap& map = slam->map();
	ASSERT_GT(map.nodeCount(), 25);
	ASSERT_EQ(map.edges().size(), size_t(map.nodeCount() - 1));
	Eigen::Isometry3d T = map.pose(0);
	for (const auto& edge : map.edges()) {
		EXPECT_EQ(edge.kind, EEdgeKind::ODOMETRY);
		T = T * edge.T_from_to;
		EXPECT_LT(localCoordinates(T, map.pose(edge.to)).norm(), 1e-9) << "node " << edge.to;
	}
	EXPECT_TRUE(map.candidates.empty());
	EXPECT_EQ(map.node(0).key_frame, nullptr) << "pictures were looked at for nothing";
	EXPECT_LT(slam->chi2(), 1e-9);
	EXPECT_NEAR(meanNodeError(*slam), meanOdometryError(*slam), 0.03);
}

TEST(DeciderRegistry, levMarqRunsAndImproves)
{
	const CTempFolder folder;
	TSetup setup = secondExperiment();
	setup.slam.slam.optimizer = "CLevMarqGSO";
	setup.config_file = iniFileOf(folder, "OptimizerParameters.LC_min_nodeid_diff=5");
	const auto slam = run(setup);
	EXPECT_GT(edgesOf(*slam, EEdgeKind::ROI), 0);
	EXPECT_LT(slam->chi2(), slam->dijkstraChi2());

	// The same graph by our optimiser, no robust loss as MRPT has none.
	TGraphLossOptions no_loss;
	no_loss.loss = "none";
	CPoseGraph graph = toPoseGraph(slam->map(), no_loss);
	CSparseOptimizer().optimize(graph);
	double farthest = 0;
	for (int i = 0; i < slam->map().nodeCount(); i++)
		farthest =
			std::max(farthest, (graph.pose(i).translation() - slam->map().pose(i).translation()).norm());
	std::printf(
		"[   INFO   ] CLevMarqGSO: chi2 %.3f (optimum %.3f, Dijkstra %.3g), farthest node %.4f m from the "
		"optimum\n",
		slam->chi2(), chi2(graph), slam->dijkstraChi2(), farthest);
	EXPECT_GE(slam->chi2(), chi2(graph) * (1 - 1e-6));
	EXPECT_LT(meanNodeError(*slam), meanOdometryError(*slam));
}
