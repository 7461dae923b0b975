#include <posidonia/apps/graph_replay.h>
#include <posidonia/apps/graph_solvers.h>
#include <posidonia/apps/mrpt_levmarq.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/chordal_initialization.h>
#include <posidonia/posegraph/graduated_nonconvexity.h>
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
	if (!takesScale(robust.kernel)) return;
	const TRobustLoss loss{kinds.at(robust.kernel), robust.scale};
	for (size_t k = 0; k < graph.edgeCount(); k++)
		if (isLoop(graph.edges()[k])) graph.setLoss(static_cast<int>(k), loss);
}

TGraphSolution solveBatch(CPoseGraph& graph, const TOptimizerOptions& options, const TRobustChoice& robust)
{
	setLosses(graph, robust);
	TOptimizerResult result = CSparseOptimizer(options).optimize(graph);
	return {
		toString(result.status), result.converged(), result.iterations, std::move(result.edge_weights), 0};
}

TGraphSolution solveGnc(CPoseGraph& graph, const TOptimizerOptions& options)
{
	TGncResult result = CGraduatedNonconvexity({}, options).optimize(graph);
	TGraphSolution out{
		toString(result.optimum.status), result.optimum.converged(), result.optimum.iterations,
		std::move(result.edge_weights), result.rounds};
	if (!result.settled) {
		out.status = "some edges neither kept nor rejected";
		out.converged = false;
	}
	return out;
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
	TGraphSolution out{toString(result.status), result.converged(), result.iterations, {}, 0};
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
	return {
		status, result.stopped && !worse, result.iterations, std::vector<double>(graph.edgeCount(), 1.0), 0};
}
}  // namespace

const std::vector<std::string>& graphStartNames()
{
	static const std::vector<std::string> names{"file", "odometry", "chordal"};
	return names;
}

std::string startGraph(CPoseGraph& graph, const std::string& start)
{
	if (start == "odometry") return startFromOdometry(graph);
	if (start == "file") return "the file's poses";
	initializeChordal(graph);
	return "chordal initialisation";
}

const std::vector<std::string>& robustKernelNames()
{
	static const std::vector<std::string> names{"none", "huber", "cauchy", "dcs", "gnc"};
	return names;
}

bool takesScale(const std::string& kernel)
{
	return kernel != "none" && kernel != "gnc";
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
	if (robust.kernel == "gnc") return solveGnc(graph, options);
	return solver == "incremental" ? solveIncremental(graph, options, robust)
								   : solveBatch(graph, options, robust);
}

std::vector<Matrix6d> marginalsOfAllNodes(const CPoseGraph& graph, const TOptimizerOptions& options)
{
	CSparseOptimizer optimizer(options);
	return optimizer.marginals(graph).allCovariances();
}
}  // namespace posidonia
