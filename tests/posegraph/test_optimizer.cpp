#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/sparse_optimizer.h>

#include "ceres_oracle.h"
#include "random_graph.h"

#include <cstring>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
TOptimizerOptions options(const std::string& method, double tolerance = 1e-14)
{
	TOptimizerOptions o;
	o.method = method;
	o.min_relative_decrease = tolerance;
	return o;
}

/** Bits of every pose. */
std::string bytesOf(const CPoseGraph& graph)
{
	std::string out;
	for (const auto& T : graph.poses())
		out.append(reinterpret_cast<const char*>(T.data()), 16 * sizeof(double));
	return out;
}

TPlantedGraph graphWithOutlier(ERobustLoss kind)
{
	auto planted = plantedGraph(11, 40, 60, 0.01, true);
	TPoseEdge wrong = planted.graph.edge(50);
	wrong.from = 2;
	wrong.to = 35;
	wrong.T_from_to = planted.truth[2].inverse() * planted.truth[35];
	wrong.T_from_to.translation() += Eigen::Vector3d(0.5, -0.4, 0.3);
	planted.graph.addEdge(wrong);
	for (int k = 39; k < int(planted.graph.edgeCount()); k++)
		planted.graph.setLoss(k, {kind, 3.0});
	return planted;
}
}  // namespace

class Methods : public ::testing::TestWithParam<std::string>
{
};
INSTANTIATE_TEST_SUITE_P(
	Both, Methods, ::testing::Values("levenberg-marquardt", "gauss-newton"), [](const auto& info) {
		return std::string(info.param == "gauss-newton" ? "GaussNewton" : "LevenbergMarquardt");
	});

TEST_P(Methods, APlantedNoiseFreeGraphComesBack)
{
	for (unsigned seed = 0; seed < 5; seed++) {
		auto planted = plantedGraph(seed, 50, 80, 0.05, false);
		perturb(planted.graph, seed + 100, 0.1);
		CSparseOptimizer optimizer(options(GetParam()));
		const auto result = optimizer.optimize(planted.graph);
		EXPECT_TRUE(result.converged()) << "seed=" << seed << " " << toString(result.status);
		EXPECT_LT(result.after.plain, 1e-12) << "seed=" << seed;
		EXPECT_GT(result.before.plain, 1) << "seed=" << seed;
		EXPECT_LT(largestDifference(planted.graph.poses(), planted.truth), 1e-8) << "seed=" << seed;
	}
}

TEST_P(Methods, OptimumEqualsCeres)
{
	for (const auto kind : {ERobustLoss::None, ERobustLoss::Huber, ERobustLoss::Cauchy}) {
		auto planted = plantedGraph(21, 30, 40, 0.05, true);
		for (int k = 0; k < int(planted.graph.edgeCount()); k++)
			planted.graph.setLoss(k, {kind, 3.0});
		const auto oracle = optimizeWithCeres(planted.graph);
		CSparseOptimizer optimizer(options(GetParam()));
		const auto result = optimizer.optimize(planted.graph);
		EXPECT_TRUE(result.converged()) << "kind=" << int(kind) << " " << toString(result.status);
		EXPECT_NEAR(result.after.robust, oracle.cost, 1e-6 * oracle.cost) << "kind=" << int(kind);
		EXPECT_LT(largestDifference(planted.graph.poses(), oracle.poses), 1e-6) << "kind=" << int(kind);
	}
}

TEST_P(Methods, RunTwiceGivesTheSameBytes)
{
	auto first = plantedGraph(4, 80, 120, 0.05, true), second = first;
	perturb(first.graph, 1, 0.05);
	perturb(second.graph, 1, 0.05);
	CSparseOptimizer fresh(options(GetParam())), used(options(GetParam()));
	auto other = plantedGraph(9, 30, 30, 0.05, true);
	used.optimize(other.graph);	 // the past must not show
	fresh.optimize(first.graph);
	used.optimize(second.graph);
	EXPECT_EQ(bytesOf(first.graph), bytesOf(second.graph));
}

TEST(Optimizer, ChiSquareOfHonestNoiseIsItsDegreesOfFreedom)
{
	double sum = 0, dof = 0;
	for (unsigned seed = 0; seed < 20; seed++) {
		auto planted = plantedGraph(seed, 30, 30, 0.01, true);
		const auto result = CSparseOptimizer().optimize(planted.graph);
		sum += result.after.plain;
		dof += result.degrees_of_freedom;
	}
	EXPECT_EQ(dof, 20 * 6 * 30);
	EXPECT_NEAR(sum / dof, 1, 4 * std::sqrt(2 / dof)) << "4 sigma of a chi-square";
}

TEST(Optimizer, LevenbergMarquardtNeverEndsWorseThanItBegan)
{
	for (unsigned seed = 0; seed < 5; seed++) {
		auto planted = plantedGraph(seed, 40, 60, 0.05, true);
		perturb(planted.graph, seed, 1.5);
		const auto result = CSparseOptimizer().optimize(planted.graph);
		EXPECT_LT(result.after.robust, result.before.robust) << "seed=" << seed;
		EXPECT_NE(result.status, EOptimizerStatus::Diverged) << "seed=" << seed;
	}
}

TEST(Optimizer, StopsAtTheIterationLimitAndSaysSo)
{
	auto planted = plantedGraph(3, 40, 60, 0.05, true);
	perturb(planted.graph, 3, 0.5);
	TOptimizerOptions few;
	few.max_iterations = 1;
	const auto result = CSparseOptimizer(few).optimize(planted.graph);
	EXPECT_EQ(result.status, EOptimizerStatus::MaxIterations);
	EXPECT_EQ(result.iterations, 1);
}

TEST(Optimizer, RobustLossesRejectAPlantedOutlierAndNoneDoesNot)
{
	const auto error = [](ERobustLoss kind, double& outlier_weight) {
		auto planted = graphWithOutlier(kind);
		const auto result = CSparseOptimizer().optimize(planted.graph);
		EXPECT_TRUE(result.converged());
		outlier_weight = result.edge_weights.back();
		return largestDifference(planted.graph.poses(), planted.truth);
	};
	double none, huber, cauchy;
	const double error_none = error(ERobustLoss::None, none);
	const double error_huber = error(ERobustLoss::Huber, huber);
	const double error_cauchy = error(ERobustLoss::Cauchy, cauchy);
	EXPECT_EQ(none, 1);
	EXPECT_LT(huber, 0.2);
	EXPECT_LT(cauchy, 0.02);
	EXPECT_GT(error_none, 0.08);
	EXPECT_LT(error_huber, 0.5 * error_none);
	EXPECT_LT(error_cauchy, 0.5 * error_none);
}

TEST(Optimizer, NamesADisconnectedNode)
{
	auto planted = plantedGraph(3, 6, 0, 0.05, true);
	planted.graph.addNode(Eigen::Isometry3d::Identity());
	CSparseOptimizer optimizer;
	try {
		optimizer.optimize(planted.graph);
		FAIL() << "node 6 has no edge";
	}
	catch (const CError& e) {
		EXPECT_NE(std::string(e.what()).find("node 6"), std::string::npos) << e.what();
	}
	planted.graph.setFixed(6, true);
	EXPECT_TRUE(optimizer.optimize(planted.graph).converged());
	planted.graph.setFixed(0, false);
	EXPECT_THROW(optimizer.optimize(planted.graph), CError) << "nothing holds nodes 0 to 5";
}

TEST(Optimizer, HoldsFixedNodesStill)
{
	auto planted = plantedGraph(8, 20, 20, 0.05, true);
	planted.graph.setFixed(7, true);
	perturb(planted.graph, 5, 0.1);
	const auto before_0 = planted.graph.pose(0).matrix(), before_7 = planted.graph.pose(7).matrix();
	CSparseOptimizer().optimize(planted.graph);
	EXPECT_EQ(planted.graph.pose(0).matrix(), before_0);
	EXPECT_EQ(planted.graph.pose(7).matrix(), before_7);
}

TEST(Optimizer, AllNodesFixedIsConvergedWithoutWork)
{
	auto planted = plantedGraph(8, 2, 0, 0.05, true);
	planted.graph.setFixed(1, true);
	const auto result = CSparseOptimizer().optimize(planted.graph);
	EXPECT_TRUE(result.converged());
	EXPECT_EQ(result.iterations, 0);
}

TEST(Optimizer, AnalysesOnceWhileTheStructureStays)
{
	auto planted = plantedGraph(2, 30, 30, 0.05, true);
	CSparseOptimizer optimizer;
	optimizer.optimize(planted.graph);
	EXPECT_EQ(optimizer.symbolicAnalyses(), 1u);
	perturb(planted.graph, 2, 0.1);
	optimizer.optimize(planted.graph);
	optimizer.marginals(planted.graph);
	EXPECT_EQ(optimizer.symbolicAnalyses(), 1u);
	planted.graph.addEdge(planted.graph.edge(3));  // a joined pair: the pattern stays
	optimizer.optimize(planted.graph);
	EXPECT_EQ(optimizer.symbolicAnalyses(), 1u);
	std::mt19937 rng(1);
	planted.graph.addNode(planted.graph.pose(29));
	planted.truth.push_back(planted.graph.pose(29));
	planted.graph.addEdge(measure(rng, planted.truth, 29, 30, 0.05, true));
	optimizer.optimize(planted.graph);
	EXPECT_EQ(optimizer.symbolicAnalyses(), 2u);
}

TEST(Optimizer, AReusedAnalysisGivesTheOptimumOfAFreshOne)
{
	auto reused = plantedGraph(2, 30, 30, 0.05, true);
	CSparseOptimizer optimizer(options("levenberg-marquardt"));
	optimizer.optimize(reused.graph);
	auto second = reused.graph.edge(3);
	std::swap(second.from, second.to);
	second.T_from_to = second.T_from_to.inverse();
	reused.graph.addEdge(second);
	auto fresh = reused;
	optimizer.optimize(reused.graph);
	CSparseOptimizer(options("levenberg-marquardt")).optimize(fresh.graph);
	EXPECT_EQ(bytesOf(reused.graph), bytesOf(fresh.graph));
}

TEST(Optimizer, RefusesAnUnknownMethod)
{
	EXPECT_THROW(CSparseOptimizer(options("newton")), CError);
}
