#include <posidonia/apps/graph_solvers.h>
#include <posidonia/apps/mrpt_levmarq.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/spanning_tree.h>

#include <cstdlib>

namespace posidonia
{
namespace
{
std::vector<int> neighbourEdges(const CPoseGraph& graph)
{
	std::vector<int> found;
	for (size_t k = 0; k < graph.edgeCount(); k++)
		if (!isLoop(graph.edges()[k])) found.push_back(static_cast<int>(k));
	return found;
}

std::string startFromOdometry(CPoseGraph& graph)
{
	try {
		initializeFromSpanningTree(graph, neighbourEdges(graph));
		return "odometry";
	}
	catch (const CError&) {	 // a gap in it
		initializeFromSpanningTree(graph);
		return "a tree of all edges (the odometry has gaps)";
	}
}

void setLosses(CPoseGraph& graph, const TRobustChoice& robust)
{
	if (robust.kernel == "none") return;
	const auto kind = robust.kernel == "huber" ? ERobustLoss::Huber : ERobustLoss::Cauchy;
	for (size_t k = 0; k < graph.edgeCount(); k++)
		if (isLoop(graph.edges()[k])) graph.setLoss(static_cast<int>(k), {kind, robust.scale});
}

TGraphSolution solveBatch(CPoseGraph& graph, const TOptimizerOptions& options, const TRobustChoice& robust)
{
	setLosses(graph, robust);
	TOptimizerResult result = CSparseOptimizer(options).optimize(graph);
	return {toString(result.status), result.converged(), result.iterations, std::move(result.edge_weights)};
}

TGraphSolution solveLevMarq(CPoseGraph& graph, const TOptimizerOptions& options)
{
	const double before = chi2(graph);
	const TLevMarqResult result = optimizeWithLevMarq(graph, options.max_iterations);
	const bool worse = !(chi2(graph) <= before);
	const char* status = worse			  ? "chi2 rose"
						 : result.stopped ? "stopped by MRPT's criteria"
										  : "max iterations";
	return {status, result.stopped && !worse, result.iterations, std::vector<double>(graph.edgeCount(), 1.0)};
}
}  // namespace

const std::vector<std::string>& graphStartNames()
{
	static const std::vector<std::string> names{"file", "odometry"};
	return names;
}

std::string startGraph(CPoseGraph& graph, const std::string& start)
{
	return start == "odometry" ? startFromOdometry(graph) : "the file's poses";
}

const std::vector<std::string>& robustKernelNames()
{
	static const std::vector<std::string> names{"none", "huber", "cauchy"};
	return names;
}

bool isLoop(const TPoseEdge& edge)
{
	return std::abs(edge.from - edge.to) != 1;
}

const std::vector<std::string>& graphSolverNames()
{
	static const std::vector<std::string> names{"batch", "levmarq"};
	return names;
}

TGraphSolution solveGraph(
	CPoseGraph& graph, const std::string& solver, const TOptimizerOptions& options,
	const TRobustChoice& robust)
{
	return solver == "levmarq" ? solveLevMarq(graph, options) : solveBatch(graph, options, robust);
}

std::vector<Matrix6d> marginalsOfAllNodes(const CPoseGraph& graph)
{
	CSparseOptimizer optimizer;
	const CMarginals marginals = optimizer.marginals(graph);
	std::vector<Matrix6d> all;
	all.reserve(graph.nodeCount());
	for (size_t n = 0; n < graph.nodeCount(); n++)
		all.push_back(marginals.covarianceOf(static_cast<int>(n)));
	return all;
}
}  // namespace posidonia
