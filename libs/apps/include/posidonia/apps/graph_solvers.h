#pragma once

#include <posidonia/posegraph/sparse_optimizer.h>

#include <string>
#include <vector>

/** The choices of auv-graph-optimize, by name. A new solver, start or kernel is added here only. */
namespace posidonia
{
struct TRobustChoice
{
	std::string kernel{"none"};
	double scale{4.0};	///< Mahalanobis distance where the loss departs from quadratic [-]
};

struct TGraphSolution
{
	std::string status;	 ///< Why it stopped
	bool converged{false};
	int iterations{0};
	std::vector<double> edge_weights;  ///< Of each edge's information at the end, 1 without a loss
	int rounds{0};					   ///< Of graduated non-convexity; `iterations` are those of the last
};

const std::vector<std::string>& graphStartNames();
/** Replaces the free nodes' poses: `file` leaves them; `odometry` composes the edges between neighbours,
 * and where these do not reach every node, a breadth-first tree of all edges; `chordal` is
 * initializeChordal(). Returns what was done, in words. Throws CError naming a node that is not reached. */
std::string startGraph(CPoseGraph& graph, const std::string& start);

const std::vector<std::string>& robustKernelNames();
/** Has the kernel a TRobustChoice::scale? `none` and `gnc` have none: gnc rejects beyond the chi-square test
 * of TGncOptions. */
bool takesScale(const std::string& kernel);
/** Not between neighbours, whose ids follow one another. */
bool isLoop(const TPoseEdge& edge);

const std::vector<std::string>& graphSolverNames();
/** `incremental` plays the graph node by node (graph_replay.h): only the fixed nodes' poses are looked at.
 * Robust kernels are for the loops, the odometry is trusted; `levmarq` knows none, `incremental` no `gnc`.
 * Throws CError. */
TGraphSolution solveGraph(
	CPoseGraph& graph, const std::string& solver, const TOptimizerOptions& options,
	const TRobustChoice& robust);

/** Covariance of (rho, phi) of every node at the graph's poses and losses; zero for fixed ones. */
std::vector<Matrix6d> marginalsOfAllNodes(const CPoseGraph& graph, const TOptimizerOptions& options);
}  // namespace posidonia
