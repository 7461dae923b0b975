#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/chordal_initialization.h>
#include <posidonia/posegraph/g2o_file.h>
#include <posidonia/posegraph/sparse_optimizer.h>

#include <cstdlib>
#include <filesystem>

#include "random_graph.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
std::string publicGraph(const std::string& name)
{
	const char* given = std::getenv("POSIDONIA_DATA");
	const std::string folder = given ? given : POSIDONIA_SOURCE_DIR "/../shared/data";
	return folder + "/pose-graphs/" + name + ".g2o";
}
}  // namespace

TEST(ChordalInitialization, RecoversNoiseFreePosesFromAnyStart)
{
	for (const bool prior_only : {false, true}) {
		auto planted = plantedGraph(5, 60, 40, 0.1, false);
		if (prior_only) {
			TPosePrior prior;
			prior.node = 7;
			prior.T_map_node = planted.truth[7];
			planted.graph.addPrior(prior);
			planted.graph.setFixed(0, false);
		}
		else
			planted.graph.setFixed(31, true);
		for (int i = 0; i < 60; i++)
			if (!planted.graph.isFixed(i)) planted.graph.setPose(i, Eigen::Isometry3d::Identity());
		initializeChordal(planted.graph);
		EXPECT_LT(largestDifference(planted.graph.poses(), planted.truth), 1e-8) << prior_only;
	}
}

TEST(ChordalInitialization, NamesANodeThatItCannotReach)
{
	auto planted = plantedGraph(5, 10, 0, 0.1, true);
	planted.graph.setLoss(4, {ERobustLoss::None, 1, 0});  // switched off
	const auto before = planted.graph.poses();
	try {
		initializeChordal(planted.graph);
		FAIL() << "nodes 5 to 9 hang on an edge of weight 0";
	}
	catch (const CError& error) {
		EXPECT_NE(std::string(error.what()).find("node 5"), std::string::npos) << error.what();
	}
	EXPECT_EQ(largestDifference(planted.graph.poses(), before), 0);
}

/** From all poses at the identity, Gauss-Newton then needs few steps. */
TEST(ChordalInitialization, PublicGraphsReachTheirOptimumInFewSteps)
{
	const std::vector<std::pair<const char*, double>> graphs = {
		{"sphere2500", 727.1497}, {"parking-garage", 1.238691}};
	for (const auto& [name, optimum] : graphs) {
		const std::string path = publicGraph(name);
		if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent; set POSIDONIA_DATA";
		auto file = readG2o(path);
		for (int i = 1; i < int(file.graph.nodeCount()); i++)
			file.graph.setPose(i, Eigen::Isometry3d::Identity());
		initializeChordal(file.graph);
		TOptimizerOptions options;
		options.method = "gauss-newton";
		const auto result = CSparseOptimizer(options).optimize(file.graph);
		RecordProperty(name, result.iterations);
		EXPECT_TRUE(result.converged()) << name << ": " << toString(result.status);
		EXPECT_NEAR(result.after.plain, optimum, 1e-6 * optimum) << name;
		EXPECT_LE(result.iterations, 6) << name;
	}
}
