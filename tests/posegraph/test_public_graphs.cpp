#include <gtest/gtest.h>
#include <posidonia/posegraph/g2o_file.h>
#include <posidonia/posegraph/incremental_optimizer.h>
#include <posidonia/posegraph/sparse_optimizer.h>

#include "arrival.h"

#include <cstdlib>
#include <filesystem>

using namespace posidonia;

namespace
{
struct TPublicGraph
{
	const char* name;
	double optimum;	 ///< chi2 of g2o's residual at the optimum
};

std::string pathOf(const char* name)
{
	const char* given = std::getenv("POSIDONIA_DATA");
	const std::string folder = given ? given : POSIDONIA_SOURCE_DIR "/../shared/data";
	return folder + "/pose-graphs/" + name + ".g2o";
}
}  // namespace

class PublicGraphs : public ::testing::TestWithParam<TPublicGraph>
{
};
INSTANTIATE_TEST_SUITE_P(
	Known, PublicGraphs,
	::testing::Values(TPublicGraph{"sphere2500", 727.1497}, TPublicGraph{"parking-garage", 1.238691}),
	[](const auto& known) {
		std::string name = known.param.name;
		std::replace(name.begin(), name.end(), '-', '_');
		return name;
	});

TEST_P(PublicGraphs, ReachTheKnownOptimum)
{
	const std::string path = pathOf(GetParam().name);
	if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent; set POSIDONIA_DATA";
	for (const std::string method : {"levenberg-marquardt", "gauss-newton"}) {
		auto file = readG2o(path);
		TOptimizerOptions options;
		options.method = method;
		const auto result = CSparseOptimizer(options).optimize(file.graph);
		EXPECT_TRUE(result.converged()) << method << ": " << toString(result.status);
		EXPECT_NEAR(result.after.plain, GetParam().optimum, 1e-6 * GetParam().optimum) << method;
		EXPECT_LE(result.iterations, 12) << method;
	}
}

/** A node every now and then is compared; sphere2500's noise is large, so much is linearised anew. */
TEST(PublicGraph, ArrivingNodeByNodeStaysAtTheBatchOptimum)
{
	const std::string path = pathOf("sphere2500");
	if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent; set POSIDONIA_DATA";
	const CPoseGraph whole = readG2o(path).graph;
	posidonia::testing::CArrival arrival(whole);
	CIncrementalOptimizer optimizer;
	while (arrival.graph.nodeCount() < 400) {
		const int node = arrival.addNode();
		optimizer.update(arrival.graph);
		if (node % 100 != 99) continue;
		CPoseGraph batch = arrival.graph;
		CSparseOptimizer().optimize(batch);
		EXPECT_LE(chi2(arrival.graph), 1.001 * chi2(batch)) << "after node " << node;
	}
	CPoseGraph batch = arrival.graph;
	CSparseOptimizer().optimize(batch);
	optimizer.refine(arrival.graph);
	EXPECT_NEAR(chi2(arrival.graph), chi2(batch), 1e-6 * chi2(batch));
}
