#include <gtest/gtest.h>
#include <posidonia/posegraph/g2o_file.h>
#include <posidonia/posegraph/sparse_optimizer.h>

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
	::testing::Values(TPublicGraph{"sphere2500", 727.1497}, TPublicGraph{"parking-garage", 1.238691}));

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
