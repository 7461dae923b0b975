#pragma once

#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/incremental_optimizer.h>
#include <synthetic_graphs.h>

#include "arrival.h"
#include "random_graph.h"

/** Graphs that grow, and what CIncrementalOptimizer promises of them. */
namespace posidonia::testing
{
/** Small tracks, so that 400 nodes hold cross-lines and wide separators. */
inline TLawnMower survey(int nodes, unsigned seed = 1)
{
	TLawnMower options;
	options.nodes = nodes;
	options.track = 30;
	options.tracks_a_block = 5;
	options.seed = seed;
	return options;
}

inline TOptimizerOptions exact()
{
	TOptimizerOptions options;
	options.min_relative_decrease = 1e-15;
	return options;
}

/** For edges good to millimetres between far poses, as the engine has them; the default lets a pose turn by
 * 0.1 rad before it is linearised anew. */
inline TIncrementalOptions tight()
{
	TIncrementalOptions options;
	options.relinearize_step = 1e-3;
	options.solve_tolerance = 1e-5;
	return options;
}

/** Updates until nothing waits to be linearised anew. */
inline void settle(CIncrementalOptimizer& optimizer, CPoseGraph& graph)
{
	int updates = 0;
	for (bool busy = true; busy && updates < 60; updates++) {
		const auto result = optimizer.update(graph);
		busy = result.relinearized + result.waiting > 0;
	}
	EXPECT_LT(updates, 60) << "does not settle";
}

/** The optimum near the graph's present states. */
inline CPoseGraph batchOptimum(CPoseGraph graph)
{
	const auto result = CSparseOptimizer(exact()).optimize(graph);
	EXPECT_TRUE(result.converged()) << toString(result.status);
	return graph;
}

inline double robustChi2(const CPoseGraph& graph)
{
	return chi2At(graph, graph.states()).robust;
}

inline double largestDistance(const CPoseGraph& a, const CPoseGraph& b)
{
	double worst = 0;
	for (size_t i = 0; i < a.nodeCount(); i++)
		worst = std::max(worst, (a.poses()[i].translation() - b.poses()[i].translation()).norm());
	return worst;
}

/** What the optimiser promises of every update. */
inline void expectNearBatch(const CPoseGraph& graph, const std::string& where, double chi2_part = 1e-3)
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
inline void expectRefinedEqualsBatch(CIncrementalOptimizer& optimizer, CPoseGraph& graph)
{
	const CPoseGraph batch = batchOptimum(graph);
	EXPECT_TRUE(optimizer.refine(graph).converged());
	const double expected = robustChi2(batch);
	EXPECT_NEAR(robustChi2(graph), expected, 1e-9 * expected + 1e-12);
	EXPECT_LT(largestDifference(graph.poses(), batch.poses()), 1e-6);
}

inline void arriveAll(
	CArrival& arrival, CIncrementalOptimizer& optimizer, int check_every = 0, bool settled = false)
{
	while (arrival.more()) {
		const int node = arrival.addNode();
		optimizer.update(arrival.graph);
		if (check_every == 0 || (node + 1) % check_every != 0) continue;
		if (settled) settle(optimizer, arrival.graph);
		expectNearBatch(arrival.graph, "after node " + std::to_string(node));
	}
}

inline std::string bytesOf(const CPoseGraph& graph)
{
	std::string out;
	for (const auto& T : graph.poses())
		out.append(reinterpret_cast<const char*>(T.data()), 16 * sizeof(double));
	return out;
}

inline Eigen::Isometry3d noisy(std::mt19937& rng, const Eigen::Isometry3d& T, double metres, double radians)
{
	Vector6d sigmas;
	sigmas << Eigen::Vector3d::Constant(metres), Eigen::Vector3d::Constant(radians);
	return retract(T, gaussian6(rng, sigmas));
}

constexpr double kScaleError = 0.03;

/** A survey that nothing fixes: depth, roll, pitch, now and then heading and position hold it. Node 0 is the
 * scale error of all odometry edges. */
inline CPoseGraph surveyWithPriors(int poses)
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
		out.addPrior(priorOn(i + 1, EPriorKind::Depth, noisy(rng, T, 0.02, 0), 0.02));
		TPosePrior tilt = priorOn(i + 1, EPriorKind::RollPitch, noisy(rng, T, 0, 0.005), 0.005);
		out.addPrior(tilt);
		if (i % 10 == 0) out.addPrior(priorOn(i + 1, EPriorKind::Heading, noisy(rng, T, 0, 0.02), 0.02));
		if (i % 40 == 0)
			out.addPrior(priorOn(i + 1, EPriorKind::HorizontalPosition, noisy(rng, T, 0.3, 0), 0.3));
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
}  // namespace posidonia::testing
