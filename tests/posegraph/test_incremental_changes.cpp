#include <temp_folder.h>

#include "incremental_checks.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** Fixed node 0, node 1 hanging on it. */
CPoseGraph twoNodes(std::mt19937& rng, std::vector<Eigen::Isometry3d>& planted)
{
	planted = {randomPose(rng, 1, 1), randomPose(rng, 1, 1), randomPose(rng, 1, 1)};
	CPoseGraph graph;
	graph.addNode(planted[0], true);
	graph.addNode(noisy(rng, planted[1], 0.05, 0.05));
	graph.addEdge(measure(rng, planted, 0, 1, 0.01, true));
	return graph;
}
}  // namespace

TEST(Incremental, ChangedEdgesAreFollowed)
{
	const auto whole = lawnMower(survey(250));
	CArrival arrival(whole.graph);
	CIncrementalOptimizer optimizer;
	arriveAll(arrival, optimizer);
	CPoseGraph& graph = arrival.graph;
	const double before = chi2(graph);
	std::vector<int> changed;
	for (const int k : {3, 200, 201, int(graph.edgeCount()) - 1}) {
		TPoseEdge edge = graph.edge(k);
		edge.T_from_to.translation() += Eigen::Vector3d(0.01, -0.01, 0.005);
		edge.information *= 3;
		graph.setEdge(k, edge);
		changed.push_back(k);
	}
	EXPECT_GT(chi2(graph), 1.05 * before) << "the change is too small to test anything";
	optimizer.update(graph, changed);
	expectNearBatch(graph, "after the change");
	const std::string settled = bytesOf(graph);
	graph.setLoss(200, {ERobustLoss::None, 1.0, 0.0});	// switched off
	optimizer.update(graph, {200, 200});
	EXPECT_FALSE(settled == bytesOf(graph));
	expectNearBatch(graph, "after an edge was switched off");
	expectRefinedEqualsBatch(optimizer, graph);
}

TEST(Incremental, ChangedPriorsAreFollowed)
{
	const CPoseGraph whole = surveyWithPriors(120);
	CArrival arrival(whole);
	CIncrementalOptimizer optimizer(tight(), exact());
	arriveAll(arrival, optimizer);
	int k = 0;
	while (arrival.graph.prior(k).kind != EPriorKind::HorizontalPosition || arrival.graph.prior(k).node < 30)
		k++;
	TPosePrior moved = arrival.graph.prior(k);
	moved.T_map_node.translation().x() += 1;
	moved.information *= 10;
	arrival.graph.setPrior(k, moved);
	const Eigen::Isometry3d before = arrival.graph.pose(moved.node);
	optimizer.update(arrival.graph, {}, {k});
	EXPECT_GT((arrival.graph.pose(moved.node).translation() - before.translation()).norm(), 0.3);
	expectNearBatch(arrival.graph, "after the change");
	expectRefinedEqualsBatch(optimizer, arrival.graph);
}

/** Factors may come with any update, also those between nodes that have long been there. */
TEST(Incremental, FactorsMayComeLaterThanTheirNodes)
{
	const auto whole = plantedGraph(5, 60, 120, 0.01, true);
	CPoseGraph graph;
	CIncrementalOptimizer optimizer(tight(), exact());
	for (int i = 0; i < 60; i++) {
		graph.addNode(
			i == 0 ? whole.truth[0] : orthonormalized(graph.pose(i - 1) * whole.graph.edge(i - 1).T_from_to),
			i == 0);
		if (i > 0) graph.addEdge(whole.graph.edge(i - 1));
		if (i % 7 == 0) optimizer.update(graph);
	}
	for (int k = 59; k < int(whole.graph.edgeCount()); k++) {
		graph.addEdge(whole.graph.edge(k));
		optimizer.update(graph);
	}
	expectNearBatch(graph, "all edges");
	expectRefinedEqualsBatch(optimizer, graph);
}

TEST(Incremental, AnUnheldNodeIsNamedAndTheOptimiserGoesOn)
{
	std::mt19937 rng(2);
	std::vector<Eigen::Isometry3d> planted;
	CPoseGraph graph = twoNodes(rng, planted);
	CIncrementalOptimizer optimizer(tight(), exact());
	optimizer.update(graph);
	graph.addNode(noisy(rng, planted[2], 0.05, 0.05));
	for (int attempt = 0; attempt < 2; attempt++) {
		const std::string message = errorOf<CError>([&] { optimizer.update(graph); });
		EXPECT_NE(message.find("node 2"), std::string::npos) << message << ", attempt " << attempt;
	}
	graph.addEdge(measure(rng, planted, 1, 2, 0.01, true));
	optimizer.update(graph);
	expectNearBatch(graph, "after the edge came");
	graph.addEdge(measure(rng, planted, 0, 2, 0.01, true));
	optimizer.update(graph);
	expectNearBatch(graph, "and one more");
	expectRefinedEqualsBatch(optimizer, graph);
}

/** In the middle of a survey, whose cliques have then been taken out. */
TEST(Incremental, ASurveyGoesOnAfterAnUnheldNode)
{
	const auto whole = lawnMower(survey(160));
	CArrival arrival(whole.graph);
	CIncrementalOptimizer optimizer;
	while (arrival.more()) {
		const int node = arrival.addNodeAlone();
		if (node == 100) {
			const std::string message = errorOf<CError>([&] { optimizer.update(arrival.graph); });
			EXPECT_NE(message.find("node 100"), std::string::npos) << message;
		}
		arrival.addFactorsOf(node);
		optimizer.update(arrival.graph);
	}
	expectNearBatch(arrival.graph, "at the end");
	expectRefinedEqualsBatch(optimizer, arrival.graph);
}

/** An edge of weight zero holds nothing, though it is there. */
TEST(Incremental, ANodeWithoutInformationIsNamedAndTheOptimiserGoesOn)
{
	std::mt19937 rng(2);
	std::vector<Eigen::Isometry3d> planted;
	CPoseGraph graph = twoNodes(rng, planted);
	CIncrementalOptimizer optimizer(tight(), exact());
	optimizer.update(graph);
	graph.addNode(noisy(rng, planted[2], 0.05, 0.05));
	TPoseEdge edge = measure(rng, planted, 1, 2, 0.01, true);
	edge.loss.weight = 0;
	const int k = graph.addEdge(edge);
	const std::string message = errorOf<CError>([&] { optimizer.update(graph); });
	EXPECT_NE(message.find("node 2"), std::string::npos) << message;
	graph.setLoss(k, {});
	optimizer.update(graph, {k});
	expectNearBatch(graph, "after the weight came");
	expectRefinedEqualsBatch(optimizer, graph);
}

TEST(Incremental, NothingToDoIsNoError)
{
	CPoseGraph graph;
	CIncrementalOptimizer optimizer;
	EXPECT_EQ(optimizer.update(graph).eliminated, 0) << "an empty graph";
	graph.addNode(Eigen::Isometry3d::Identity(), true);
	EXPECT_EQ(optimizer.update(graph).eliminated, 0) << "a fixed node alone";
	optimizer.refine(graph);
	EXPECT_TRUE(optimizer.marginals().covarianceOf(0).isZero());
	graph.addErrorVariable(Vector6d::Constant(0.1), Matrix6d::Identity());
	EXPECT_EQ(optimizer.update(graph).eliminated, 1);
	EXPECT_TRUE(graph.errorVariable(1).isApprox(Vector6d::Constant(0.1), 1e-12));
}

TEST(Incremental, RefineMayBeTheFirstCall)
{
	auto whole = lawnMower(survey(150));
	CIncrementalOptimizer optimizer;
	expectRefinedEqualsBatch(optimizer, whole.graph);
	EXPECT_EQ(optimizer.update(whole.graph).solved, 0);
}

/** refine() may be the first to see new nodes. */
TEST(Incremental, RefineTakesOverWhatIsNew)
{
	const auto whole = lawnMower(survey(150));
	CArrival arrival(whole.graph);
	CIncrementalOptimizer optimizer;
	while (arrival.more()) {
		const int node = arrival.addNode();
		if (node == 70)
			optimizer.refine(arrival.graph);
		else if (node != 69)
			optimizer.update(arrival.graph);
	}
	expectNearBatch(arrival.graph, "at the end");
	expectRefinedEqualsBatch(optimizer, arrival.graph);
}
