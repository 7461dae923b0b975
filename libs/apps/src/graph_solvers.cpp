#include <posidonia/apps/graph_replay.h>
#include <posidonia/apps/graph_solvers.h>
#include <posidonia/apps/mrpt_levmarq.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/incremental_optimizer.h>
#include <posidonia/posegraph/spanning_tree.h>

#include <cstdlib>
#include <map>

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
	static const std::map<std::string, ERobustLoss> kinds{
		{"huber", ERobustLoss::Huber}, {"cauchy", ERobustLoss::Cauchy}, {"dcs", ERobustLoss::Dcs}};
	if (robust.kernel == "none") return;
	const TRobustLoss loss{kinds.at(robust.kernel), robust.scale};
	for (size_t k = 0; k < graph.edgeCount(); k++)
		if (isLoop(graph.edges()[k])) graph.setLoss(static_cast<int>(k), loss);
}

TGraphSolution solveBatch(CPoseGraph& graph, const TOptimizerOptions& options, const TRobustChoice& robust)
{
	setLosses(graph, robust);
	TOptimizerResult result = CSparseOptimizer(options).optimize(graph);
	return {toString(result.status), result.converged(), result.iterations, std::move(result.edge_weights)};
}

/** As if it had arrived node by node, and exact at the end. */
TGraphSolution solveIncremental(
	CPoseGraph& graph, const TOptimizerOptions& options, const TRobustChoice& robust)
{
	setLosses(graph, robust);
	CPoseGraph growing;
	CGraphReplay arrival(graph);
	CIncrementalOptimizer optimizer({}, options);
	while (!arrival.done())
		if (arrival.addNext(growing) || arrival.done()) optimizer.update(growing);
	const TOptimizerResult result = optimizer.refine(growing);
	graph.setPoses(growing.poses());
	TGraphSolution out{toString(result.status), result.converged(), result.iterations, {}};
	out.edge_weights.resize(graph.edgeCount());
	for (size_t k = 0; k < graph.edgeCount(); k++)
		out.edge_weights[static_cast<size_t>(arrival.edgeOrder()[k])] = result.edge_weights[k];
	return out;
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
	static const std::vector<std::string> names{"none", "huber", "cauchy", "dcs"};
	return names;
}

bool isLoop(const TPoseEdge& edge)
{
	return std::abs(edge.from - edge.to) != 1;
}

const std::vector<std::string>& graphSolverNames()
{
	static const std::vector<std::string> names{"batch", "incremental", "levmarq"};
	return names;
}

TGraphSolution solveGraph(
	CPoseGraph& graph, const std::string& solver, const TOptimizerOptions& options,
	const TRobustChoice& robust)
{
	if (solver == "levmarq") return solveLevMarq(graph, options);
	return solver == "incremental" ? solveIncremental(graph, options, robust)
								   : solveBatch(graph, options, robust);
}

std::vector<Matrix6d> marginalsOfAllNodes(const CPoseGraph& graph)
{
	CSparseOptimizer optimizer;
	return optimizer.marginals(graph).allCovariances();
}
}  // namespace posidonia
