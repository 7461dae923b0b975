#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/spanning_tree.h>
#include <temp_folder.h>

#include "random_graph.h"

#include <functional>
#include <limits>

using namespace posidonia;
using namespace posidonia::testing;

TEST(PoseGraph, RefusesBadEdgesByName)
{
	const auto planted = plantedGraph(1, 5, 0, 0.1, true);
	struct TBad
	{
		const char* problem;
		std::function<void(TPoseEdge&)> spoil;
	};
	const std::vector<TBad> bad = {
		{"node does not exist", [](TPoseEdge& e) { e.to = 9; }},
		{"node does not exist", [](TPoseEdge& e) { e.from = -1; }},
		{"same node", [](TPoseEdge& e) { e.to = e.from; }},
		{"not finite", [](TPoseEdge& e) { e.T_from_to.translation().x() = std::nan(""); }},
		{"not orthonormal", [](TPoseEdge& e) { e.T_from_to.linear() *= 1.01; }},
		{"positive definite", [](TPoseEdge& e) { e.information(2, 2) = -1; }},
		{"positive definite", [](TPoseEdge& e) { e.information(0, 1) += 100; }},
		{"positive definite", [](TPoseEdge& e) { e.information(0, 0) = std::nan(""); }},
		{"scale",
		 [](TPoseEdge& e) {
			 e.loss = {ERobustLoss::Huber, 0};
		 }},
	};
	for (const TBad& b : bad) {
		CPoseGraph graph = planted.graph;
		TPoseEdge edge = graph.edge(2);
		b.spoil(edge);
		const std::string message = errorOf<CError>([&] { graph.addEdge(edge); });
		EXPECT_NE(message.find(b.problem), std::string::npos) << message;
		EXPECT_NE(message.find("edge 4 (" + std::to_string(edge.from)), std::string::npos) << message;
		EXPECT_EQ(graph.edgeCount(), 4u) << b.problem;
	}
}

TEST(PoseGraph, RefusesBadNodes)
{
	CPoseGraph graph;
	Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
	T.translation().z() = std::numeric_limits<double>::infinity();
	EXPECT_NE(errorOf<CError>([&] { graph.addNode(T); }).find("node 0"), std::string::npos);
	EXPECT_NE(errorOf<CError>([&] { graph.pose(3); }).find("node 3"), std::string::npos);
}

TEST(PoseGraph, TakesASecondEdgeBetweenTheSamePair)
{
	auto planted = plantedGraph(1, 3, 0, 0.1, true);
	const double before = chi2(planted.graph);
	TPoseEdge again = planted.graph.edge(1);
	planted.graph.addEdge(again);
	EXPECT_DOUBLE_EQ(chi2(planted.graph), before + edgesMahalanobis2(planted.graph)[1]);
}

TEST(SpanningTree, RecoversNoiseFreePoses)
{
	auto planted = plantedGraph(5, 60, 40, 0.1, false);
	perturb(planted.graph, 1, 1.0);
	initializeFromSpanningTree(planted.graph);
	EXPECT_LT(largestDifference(planted.graph.poses(), planted.truth), 1e-9);
}

TEST(SpanningTree, AlongTheChainOnlyIsDeadReckoning)
{
	auto planted = plantedGraph(5, 10, 20, 0.1, true);
	std::vector<int> chain;
	for (int k = 0; k < 9; k++)
		chain.push_back(k);
	initializeFromSpanningTree(planted.graph, chain);
	Eigen::Isometry3d T = planted.truth[0];
	for (int k = 0; k < 9; k++) {
		T = T * planted.graph.edge(k).T_from_to;
		EXPECT_LT(localCoordinates(T, planted.graph.pose(k + 1)).norm(), 1e-9) << "k=" << k;
	}
}

TEST(SpanningTree, NamesANodeThatItCannotReach)
{
	auto planted = plantedGraph(5, 10, 0, 0.1, true);
	const auto message = errorOf<CError>([&] { initializeFromSpanningTree(planted.graph, {0, 1, 2, 4}); });
	EXPECT_NE(message.find("node 4"), std::string::npos) << message;
}
