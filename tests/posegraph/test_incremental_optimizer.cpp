#include "incremental_checks.h"

using namespace posidonia;
using namespace posidonia::testing;

TEST(Incremental, ASurveyStaysAtTheBatchOptimum)
{
	const auto whole = lawnMower(survey(400));
	CArrival arrival(whole.graph);
	CIncrementalOptimizer optimizer;
	arriveAll(arrival, optimizer, 50);
	EXPECT_LT(largestDifference(arrival.graph.poses(), whole.planted), 0.1) << "the planted poses";
	expectRefinedEqualsBatch(optimizer, arrival.graph);
}

TEST(Incremental, ARandomGraphStaysAtTheBatchOptimum)
{
	for (unsigned seed = 0; seed < 3; seed++) {
		const auto whole = plantedGraph(seed, 200, 60, 0.01, true);
		CArrival arrival(whole.graph);
		CIncrementalOptimizer optimizer(tight(), exact());
		SCOPED_TRACE(seed);
		arriveAll(arrival, optimizer, 50, true);
		expectRefinedEqualsBatch(optimizer, arrival.graph);
	}
}

/** A survey's node costs little, wherever it lies. */
TEST(Incremental, TouchesLittleAwayFromLoops)
{
	const auto whole = lawnMower(survey(600));
	CArrival arrival(whole.graph);
	CIncrementalOptimizer optimizer;
	std::vector<int> eliminated;
	while (arrival.more()) {
		const int node = arrival.addNode();
		const auto result = optimizer.update(arrival.graph);
		EXPECT_EQ(result.new_nodes, node == 0 ? 0 : 1) << "node " << node;
		EXPECT_FALSE(result.rebuilt) << "node " << node;
		if (node >= 400) eliminated.push_back(result.eliminated);
	}
	std::nth_element(eliminated.begin(), eliminated.begin() + 100, eliminated.end());
	EXPECT_LT(eliminated[100], 120) << "median of nodes eliminated anew, of 400 to 600";
	EXPECT_EQ(optimizer.update(arrival.graph).new_factors, 0);
	EXPECT_EQ(optimizer.update(arrival.graph).solved, 0) << "nothing new, nothing waiting, yet nodes moved";
}

TEST(Incremental, TwiceIsTheSameBytes)
{
	std::string bytes[2];
	const CPoseGraph whole = surveyWithPriors(200);
	for (std::string& out : bytes) {
		CArrival arrival(whole);
		CIncrementalOptimizer optimizer;
		arriveAll(arrival, optimizer);
		out = bytesOf(arrival.graph);
		optimizer.refine(arrival.graph);
		out += bytesOf(arrival.graph);
	}
	EXPECT_TRUE(bytes[0] == bytes[1]);
}

/** By then what old cliques leave to their parents has been dropped (CBayesTree::dropRests()). */
TEST(Incremental, ALoopFarBackAfterLongIsFollowed)
{
	auto whole = lawnMower(survey(700));
	std::mt19937 rng(4);
	for (const auto [from, to] : {std::array{5, 640}, {330, 660}, {100, 661}, {40, 690}})
		whole.graph.addEdge(measure(rng, whole.planted, from, to, 0.002, true));
	CArrival arrival(whole.graph);
	CIncrementalOptimizer optimizer;
	while (arrival.more()) {
		const int node = arrival.addNode();
		const auto result = optimizer.update(arrival.graph);
		EXPECT_FALSE(result.rebuilt) << "node " << node;
		if (node == 640 || node == 660 || node == 661 || node == 690 || node == 699)
			expectNearBatch(arrival.graph, "after node " + std::to_string(node));
	}
	expectRefinedEqualsBatch(optimizer, arrival.graph);
}

TEST(Incremental, PriorsAndAnErrorVariable)
{
	const CPoseGraph whole = surveyWithPriors(250);
	CArrival arrival(whole);
	CIncrementalOptimizer optimizer(tight(), exact());
	arriveAll(arrival, optimizer, 50);
	EXPECT_NEAR(arrival.graph.errorVariable(0)[0], batchOptimum(arrival.graph).errorVariable(0)[0], 1e-4);
	EXPECT_NEAR(arrival.graph.errorVariable(0)[0], kScaleError, 0.005) << "the planted scale error";
	expectRefinedEqualsBatch(optimizer, arrival.graph);
}

TEST(Incremental, FixedNodesHoldTheirPlace)
{
	auto whole = lawnMower(survey(200));
	for (const int node : {60, 61, 150, 199}) {
		whole.graph.setPose(node, whole.planted[size_t(node)]);
		whole.graph.setFixed(node, true);
	}
	CArrival arrival(whole.graph);
	CIncrementalOptimizer optimizer;
	arriveAll(arrival, optimizer, 50);
	for (const int node : {0, 60, 61, 150, 199})
		EXPECT_EQ(arrival.graph.pose(node).matrix(), whole.planted[size_t(node)].matrix()) << "node " << node;
	EXPECT_TRUE(optimizer.marginals().covarianceOf(60).isZero());
	expectRefinedEqualsBatch(optimizer, arrival.graph);
}

TEST(Incremental, RobustLossesEndWhereTheBatchDoes)
{
	for (const auto kind : {ERobustLoss::Huber, ERobustLoss::Cauchy, ERobustLoss::Dcs}) {
		auto whole = lawnMower(survey(250));
		for (int k = 0; k < int(whole.graph.edgeCount()); k++) {
			TPoseEdge edge = whole.graph.edge(k);
			if (edge.to == edge.from + 1) continue;
			if (k % 29 == 0) edge.T_from_to.translation() += Eigen::Vector3d(0.3, 0.2, -0.1);  // wrong
			edge.loss = {kind, 4};
			whole.graph.setEdge(k, edge);
		}
		CArrival arrival(whole.graph);
		CIncrementalOptimizer optimizer(tight(), exact());
		arriveAll(arrival, optimizer);
		const CPoseGraph batch = batchOptimum(arrival.graph);
		EXPECT_LT(robustChi2(arrival.graph), 1.001 * robustChi2(batch)) << "kind=" << int(kind);
		EXPECT_LT(largestDistance(arrival.graph, batch), 1e-3) << "kind=" << int(kind);
		SCOPED_TRACE(int(kind));
		expectRefinedEqualsBatch(optimizer, arrival.graph);
	}
}
