#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/incremental_optimizer.h>
#include <synthetic_graphs.h>

#include "arrival.h"
#include "random_graph.h"

#include <functional>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** Small tracks, so that 400 nodes hold cross-lines and wide separators. */
TLawnMower survey(int nodes, unsigned seed = 1)
{
	TLawnMower options;
	options.nodes = nodes;
	options.track = 30;
	options.tracks_a_block = 5;
	options.seed = seed;
	return options;
}

TOptimizerOptions exact()
{
	TOptimizerOptions options;
	options.min_relative_decrease = 1e-15;
	return options;
}

/** For tight edges between far poses: the default lets a pose turn by 0.1 rad before it is linearised anew.
 */
TIncrementalOptions tight()
{
	TIncrementalOptions options;
	options.relinearize_step = 1e-5;
	options.solve_tolerance = 1e-8;
	options.max_work = 1;  // of a dense little graph one node takes nearly all with it
	return options;
}

/** Updates until nothing waits to be linearised anew. */
void settle(CIncrementalOptimizer& optimizer, CPoseGraph& graph)
{
	int updates = 0;
	for (bool busy = true; busy && updates < 60; updates++) {
		const auto result = optimizer.update(graph);
		busy = result.relinearized + result.waiting > 0;
	}
	EXPECT_LT(updates, 60) << "does not settle";
}

/** The optimum near the graph's present states. */
CPoseGraph batchOptimum(CPoseGraph graph)
{
	const auto result = CSparseOptimizer(exact()).optimize(graph);
	EXPECT_TRUE(result.converged()) << toString(result.status);
	return graph;
}

double robustChi2(const CPoseGraph& graph)
{
	return chi2At(graph, graph.states()).robust;
}

double largestDistance(const CPoseGraph& a, const CPoseGraph& b)
{
	double worst = 0;
	for (size_t i = 0; i < a.nodeCount(); i++)
		worst = std::max(worst, (a.poses()[i].translation() - b.poses()[i].translation()).norm());
	return worst;
}

/** What the optimiser promises of every update. */
void expectNearBatch(const CPoseGraph& graph, const std::string& where, double chi2_part = 1e-3)
{
	const CPoseGraph batch = batchOptimum(graph);
	const double expected = robustChi2(batch);
	EXPECT_LE(robustChi2(graph), expected * (1 + chi2_part) + 1e-6) << where;
	EXPECT_LT(largestDistance(graph, batch), 1e-3) << where << " [m]";
	const int newest = int(graph.nodeCount()) - 1;
	EXPECT_LT(localCoordinates(graph.pose(newest), batch.pose(newest)).lpNorm<Eigen::Infinity>(), 5e-4)
		<< where << ": the newest pose";
}

/** ... and of refine(). */
void expectRefinedEqualsBatch(CIncrementalOptimizer& optimizer, CPoseGraph& graph)
{
	const CPoseGraph batch = batchOptimum(graph);
	EXPECT_TRUE(optimizer.refine(graph).converged());
	const double expected = robustChi2(batch);
	EXPECT_NEAR(robustChi2(graph), expected, 1e-9 * expected + 1e-12);
	EXPECT_LT(largestDifference(graph.poses(), batch.poses()), 1e-6);
}

void arriveAll(CArrival& arrival, CIncrementalOptimizer& optimizer, int check_every = 0, bool settled = false)
{
	while (arrival.more()) {
		const int node = arrival.addNode();
		optimizer.update(arrival.graph);
		if (check_every == 0 || (node + 1) % check_every != 0) continue;
		if (settled) settle(optimizer, arrival.graph);
		expectNearBatch(arrival.graph, "after node " + std::to_string(node));
	}
}

std::string bytesOf(const CPoseGraph& graph)
{
	std::string out;
	for (const auto& T : graph.poses())
		out.append(reinterpret_cast<const char*>(T.data()), 16 * sizeof(double));
	return out;
}

std::string messageOf(const std::function<void()>& act)
{
	try {
		act();
	}
	catch (const CError& error) {
		return error.what();
	}
	return "(no error)";
}

Eigen::Isometry3d noisy(std::mt19937& rng, const Eigen::Isometry3d& T, double metres, double radians)
{
	Vector6d sigmas;
	sigmas << Eigen::Vector3d::Constant(metres), Eigen::Vector3d::Constant(radians);
	return retract(T, gaussian6(rng, sigmas));
}

TPosePrior prior(int node, EPriorKind kind, const Eigen::Isometry3d& measured, double sigma)
{
	TPosePrior out;
	out.node = node;
	out.kind = kind;
	out.T_map_node = measured;
	out.information = Matrix6d::Identity() / (sigma * sigma);
	return out;
}

constexpr double kScaleError = 0.03;

/** A survey that nothing fixes: depth, roll, pitch, now and then heading and position hold it. Node 0 is the
 * scale error of all odometry edges. */
CPoseGraph surveyWithPriors(int poses)
{
	const auto plain = lawnMower(survey(poses, 3));
	std::mt19937 rng(9);
	CPoseGraph out;
	Vector6d sigmas = Vector6d::Constant(0.001);
	sigmas[0] = 0.05;
	const int scale = out.addErrorVariable(Vector6d::Zero(), sigmas.cwiseAbs2().cwiseInverse().asDiagonal());
	for (int i = 0; i < poses; i++) {
		out.addNode(plain.graph.pose(i));
		const auto& T = plain.planted[size_t(i)];
		out.addPrior(prior(i + 1, EPriorKind::Depth, noisy(rng, T, 0.02, 0), 0.02));
		TPosePrior tilt = prior(i + 1, EPriorKind::RollPitch, noisy(rng, T, 0, 0.005), 0.005);
		out.addPrior(tilt);
		if (i % 10 == 0) out.addPrior(prior(i + 1, EPriorKind::Heading, noisy(rng, T, 0, 0.02), 0.02));
		if (i % 40 == 0)
			out.addPrior(prior(i + 1, EPriorKind::HorizontalPosition, noisy(rng, T, 0.3, 0), 0.3));
	}
	for (TPoseEdge edge : plain.graph.edges()) {
		const bool odometry = edge.to == edge.from + 1;
		edge.from++;
		edge.to++;
		if (odometry) {
			edge.T_from_to.translation() /= 1 - kScaleError;
			edge.error_variable = scale;
			edge.sensitivity = Matrix6d::Zero();
			edge.sensitivity.col(0).head<3>() =
				-edge.T_from_to.linear().transpose() * edge.T_from_to.translation();
		}
		out.addEdge(edge);
	}
	return out;
}

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
	settle(optimizer, arrival.graph);
	EXPECT_GT((arrival.graph.pose(moved.node).translation() - before.translation()).norm(), 0.3);
	expectNearBatch(arrival.graph, "after the change");
	expectRefinedEqualsBatch(optimizer, arrival.graph);
}

TEST(Incremental, PriorsAndAnErrorVariable)
{
	const CPoseGraph whole = surveyWithPriors(250);
	CArrival arrival(whole);
	CIncrementalOptimizer optimizer(tight(), exact());
	arriveAll(arrival, optimizer, 50, true);
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
		settle(optimizer, arrival.graph);
		const CPoseGraph batch = batchOptimum(arrival.graph);
		EXPECT_LT(robustChi2(arrival.graph), 1.001 * robustChi2(batch)) << "kind=" << int(kind);
		EXPECT_LT(largestDistance(arrival.graph, batch), 1e-3) << "kind=" << int(kind);
		SCOPED_TRACE(int(kind));
		expectRefinedEqualsBatch(optimizer, arrival.graph);
	}
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
	settle(optimizer, graph);
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
		const std::string message = messageOf([&] { optimizer.update(graph); });
		EXPECT_NE(message.find("node 2"), std::string::npos) << message << ", attempt " << attempt;
	}
	graph.addEdge(measure(rng, planted, 1, 2, 0.01, true));
	optimizer.update(graph);
	settle(optimizer, graph);
	expectNearBatch(graph, "after the edge came");
	graph.addEdge(measure(rng, planted, 0, 2, 0.01, true));
	optimizer.update(graph);
	settle(optimizer, graph);
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
			const std::string message = messageOf([&] { optimizer.update(arrival.graph); });
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
	const std::string message = messageOf([&] { optimizer.update(graph); });
	EXPECT_NE(message.find("node 2"), std::string::npos) << message;
	graph.setLoss(k, {});
	optimizer.update(graph, {k});
	settle(optimizer, graph);
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

TEST(Incremental, MarginalsEqualTheBatchs)
{
	const CPoseGraph whole = surveyWithPriors(150);
	CArrival arrival(whole);
	CIncrementalOptimizer optimizer;
	arriveAll(arrival, optimizer);
	optimizer.refine(arrival.graph);
	CSparseOptimizer batch;
	const auto expected = batch.marginals(arrival.graph), got = optimizer.marginals();
	const auto all = got.allCovariances();
	ASSERT_EQ(all.size(), arrival.graph.nodeCount());
	for (int i = 0; i < int(all.size()); i++) {
		const Matrix6d S = expected.covarianceOf(i);
		EXPECT_LT((got.covarianceOf(i) - S).norm(), 1e-6 * S.norm()) << "node " << i;
		EXPECT_LT((all[size_t(i)] - S).norm(), 1e-6 * S.norm()) << "node " << i << " of all";
	}
	for (const auto [i, j] : {std::array{1, 150}, {30, 31}, {77, 10}}) {
		const Matrix6d S = expected.relativeCovariance(i, j);
		EXPECT_LT((got.relativeCovariance(i, j) - S).norm(), 1e-6 * S.norm()) << i << ", " << j;
	}
	const Eigen::MatrixXd joint = expected.jointCovariance({0, 3, 149});
	EXPECT_LT((got.jointCovariance({0, 3, 149}) - joint).norm(), 1e-6 * joint.norm());
	optimizer.update(arrival.graph);
	EXPECT_THROW(got.covarianceOf(3), CError) << "outdated";
}

/** Between refinements too the covariance is that of the present elimination, near the batch's. */
TEST(Incremental, MarginalsOfAGrowingSurveyAreNearTheBatchs)
{
	const auto whole = lawnMower(survey(300));
	CArrival arrival(whole.graph);
	CIncrementalOptimizer optimizer;
	while (arrival.more()) {
		const int node = arrival.addNode();
		optimizer.update(arrival.graph);
		if (node % 60 != 59) continue;
		CSparseOptimizer batch;
		const auto expected = batch.marginals(arrival.graph), got = optimizer.marginals();
		const auto all = got.allCovariances();
		for (int i = 1; i <= node; i += 7) {
			const Matrix6d S = expected.covarianceOf(i);
			EXPECT_LT((got.covarianceOf(i) - S).norm(), 0.02 * S.norm()) << "nodes " << node << ", " << i;
			EXPECT_LT((all[size_t(i)] - got.covarianceOf(i)).norm(), 1e-8 * S.norm()) << node << ", " << i;
		}
	}
}
