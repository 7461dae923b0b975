#include <gtest/gtest.h>
#include <posidonia/base/chi_square.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/edge_support.h>
#include <posidonia/posegraph/graduated_nonconvexity.h>

#include <cstring>

#include "generated_sphere.h"

using namespace posidonia;
using namespace posidonia::testing;

TEST(GraduatedNonconvexity, WeightsFallFromOneToZeroAndBecomeATruncation)
{
	for (const double mu : {1e-4, 0.1, 1.0, 50.0}) {
		double last = 1;
		for (double s = 0.01; s < 1e6; s *= 1.3) {
			const double w = gncWeight(s, 10, mu);
			EXPECT_GE(w, 0) << "mu=" << mu << " s=" << s;
			EXPECT_LE(w, last) << "mu=" << mu << " s=" << s;
			last = w;
		}
		EXPECT_EQ(last, mu < 1e-3 ? gncWeight(1e6, 10, mu) : 0);
	}
	EXPECT_EQ(gncWeight(9.9, 10, 1e6), 1);
	EXPECT_EQ(gncWeight(10.1, 10, 1e6), 0);
}

TEST(GraduatedNonconvexity, FindsThirtyPercentWrongLoopsOfASphere)
{
	for (unsigned seed = 1; seed <= 2; seed++) {
		auto sphere = generatedSphere(seed, 20, 0.22, 0.3);
		CPoseGraph oracle = trueEdgesOnly(sphere);
		CSparseOptimizer().optimize(oracle);
		const auto result = CGraduatedNonconvexity().optimize(sphere.graph);
		EXPECT_TRUE(result.settled && result.optimum.converged()) << "seed=" << seed;
		for (size_t k = 0; k < sphere.wrong.size(); k++) {
			EXPECT_EQ(result.edge_weights[k], sphere.wrong[k] ? 0 : 1) << "seed=" << seed << " edge " << k;
			EXPECT_EQ(result.optimum.edge_weights[k], result.edge_weights[k]);
			EXPECT_EQ(sphere.graph.edge(int(k)).loss.weight, result.edge_weights[k]);
		}
		EXPECT_EQ(result.rejectedEdges().size(), size_t(0.3 * 380)) << "seed=" << seed;
		EXPECT_LT(
			meanPositionError(sphere.graph, sphere.truth), 1.001 * meanPositionError(oracle, sphere.truth))
			<< "seed=" << seed;
	}
}

/** Random chords: few confirm one another, so that the start is far from what other true ones say. */
TEST(GraduatedNonconvexity, FindsWrongLoopsAmongScatteredOnes)
{
	for (unsigned seed = 1; seed <= 6; seed++) {
		auto planted = plantedGraph(seed, 50, 30, 0.01, true);
		std::vector<int> chain;
		for (int k = 0; k < 49; k++)
			chain.push_back(k);
		std::vector<char> wrong(79, 0);
		for (int k = 50; k < 79; k += 4) {
			TPoseEdge edge = planted.graph.edge(k);
			edge.T_from_to.translation() += Eigen::Vector3d(0.8, -1, 0.9);
			planted.graph.setEdge(k, edge);
			wrong[k] = 1;
		}
		const auto result = CGraduatedNonconvexity().optimize(planted.graph, chain);
		for (size_t k = 0; k < wrong.size(); k++)
			EXPECT_EQ(result.edge_weights[k], wrong[k] ? 0 : 1) << "seed=" << seed << " edge " << k;
		std::vector<int> right;
		for (int k = 0; k < 79; k++)
			if (!wrong[k]) right.push_back(k);
		CPoseGraph oracle = planted.graph.withEdges(right);
		oracle.setPoses(planted.truth);
		CSparseOptimizer().optimize(oracle);
		EXPECT_LT(largestDifference(planted.graph.poses(), oracle.poses()), 1e-5) << "seed=" << seed;
	}
}

/** The wrong one goes; a true one beside it may go, too (README). */
TEST(GraduatedNonconvexity, WithoutNeighboursStartsFromAllEdges)
{
	auto planted = plantedGraph(4, 60, 0, 0.003, true);
	std::mt19937 rng(8);
	std::vector<int> chain, open;
	for (int k = 0; k < 59; k++)
		chain.push_back(k);
	for (int from = 0; from < 30; from += 7)
		open.push_back(planted.graph.addEdge(measure(rng, planted.truth, from, from + 29, 0.003, true)));
	TPoseEdge edge = planted.graph.edge(open[2]);
	edge.T_from_to.translation().x() += 2;
	planted.graph.setEdge(open[2], edge);
	ASSERT_TRUE(supportedEdges(planted.graph, chain, open, chiSquareQuantile(0.999, 6)).empty());
	const auto result = CGraduatedNonconvexity().optimize(planted.graph, chain);
	EXPECT_EQ(result.edge_weights[open[2]], 0);
	EXPECT_LE(result.rejectedEdges().size(), 2u);
	EXPECT_TRUE(result.settled && result.optimum.converged());
}

TEST(GraduatedNonconvexity, CleanGraphsLoseNothingAndTwiceGivesTheSameBytes)
{
	auto first = generatedSphere(3, 12, 0.22, 0), second = first;
	const auto result = CGraduatedNonconvexity().optimize(first.graph);
	EXPECT_TRUE(result.rejectedEdges().empty());
	CGraduatedNonconvexity().optimize(second.graph);
	for (size_t i = 0; i < first.truth.size(); i++)
		EXPECT_EQ(first.graph.poses()[i].matrix(), second.graph.poses()[i].matrix()) << "node " << i;
	EXPECT_THROW(CGraduatedNonconvexity().optimize(first.graph, {9999}), CError);
}

TEST(EdgeSupport, ConfirmsTrueLoopsAndNoWrongOne)
{
	const auto sphere = generatedSphere(2, 20, 1.0, 0.3);
	std::vector<int> odometry, loops;
	for (int k = 0; k < int(sphere.graph.edgeCount()); k++)
		(k < 399 ? odometry : loops).push_back(k);
	const auto supported = supportedEdges(sphere.graph, odometry, loops, chiSquareQuantile(0.999, 6));
	int right = 0;
	for (const int k : supported)
		right += !sphere.wrong[k];
	EXPECT_GE(right, int(0.9 * 0.7 * 380));
	EXPECT_LE(int(supported.size()) - right, 1);
}
