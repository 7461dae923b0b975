#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/graphslam/levmarq.h>
#include <posidonia/apps/mrpt_levmarq.h>
#include <posidonia/geometry/mrpt_pose.h>

namespace posidonia
{
namespace
{
using TMrptGraph = mrpt::graphs::CNetworkOfPoses3DInf;
using TNode = mrpt::graphs::TNodeID;

TMrptGraph toMrptGraph(const CPoseGraph& graph)
{
	TMrptGraph out;
	for (int i = 0; i < static_cast<int>(graph.nodeCount()); i++)
		out.nodes[static_cast<TNode>(i)] = TMrptGraph::global_pose_t(toMrpt(graph.pose(i)));
	for (const TPoseEdge& e : graph.edges())
		out.insertEdge(
			static_cast<TNode>(e.from), static_cast<TNode>(e.to),
			toMrptGaussianInf(e.T_from_to, e.information));
	return out;
}

std::set<TNode> freeNodes(const CPoseGraph& graph)
{
	std::set<TNode> free;
	for (int i = 0; i < static_cast<int>(graph.nodeCount()); i++)
		if (!graph.isFixed(i)) free.insert(static_cast<TNode>(i));
	return free;
}
}  // namespace

TLevMarqResult optimizeWithLevMarq(CPoseGraph& graph, int max_iterations)
{
	const auto free = freeNodes(graph);
	if (free.empty() || graph.edges().empty()) return {0, true};
	TMrptGraph work = toMrptGraph(graph);
	mrpt::containers::yaml params;
	params["max_iterations"] = max_iterations;
	mrpt::graphslam::TResultInfoSpaLevMarq info{};
	mrpt::graphslam::optimize_graph_spa_levmarq(work, info, &free, params);
	for (const TNode id : free)
		graph.setPose(static_cast<int>(id), orthonormalized(fromMrpt(work.nodes.at(id))));
	const int iterations = static_cast<int>(info.num_iters) + 1;  // num_iters is the last one's index
	return {iterations, iterations < max_iterations};
}
}  // namespace posidonia
