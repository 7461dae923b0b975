#include <posidonia/base/error.h>
#include <posidonia/posegraph/spanning_tree.h>

#include <deque>
#include <numeric>

namespace posidonia
{
namespace
{
using TNeighbours = std::vector<std::vector<int>>;	// edge indices at each node

TNeighbours edgesAtNodes(const CPoseGraph& graph, const std::vector<int>& edge_indices)
{
	TNeighbours at(graph.nodeCount());
	for (const int k : edge_indices) {
		at[graph.edge(k).from].push_back(k);
		at[graph.edge(k).to].push_back(k);
	}
	return at;
}

/** The pose of an edge's other end, from that of `node`. */
Eigen::Isometry3d acrossEdge(
	const CPoseGraph& graph, const TPoseEdge& edge, int node, const Eigen::Isometry3d& T_map_node)
{
	const Eigen::Isometry3d T_from_to =
		edge.error_variable < 0 ? edge.T_from_to
								: correctedMeasurement(edge, graph.errorVariable(edge.error_variable));
	return edge.from == node ? T_map_node * T_from_to : T_map_node * T_from_to.inverse();
}

/** The nodes whose pose is known beforehand: fixed ones, and those with a full-pose prior, put there. */
std::vector<char> anchors(const CPoseGraph& graph, std::vector<Eigen::Isometry3d>& poses)
{
	std::vector<char> anchored(graph.nodeCount(), 0);
	for (const TPosePrior& prior : graph.priors()) {
		if (prior.kind != EPriorKind::FullPose || graph.isFixed(prior.node) || anchored[prior.node]) continue;
		poses[prior.node] = prior.T_map_node;
		anchored[prior.node] = 1;
	}
	for (int node = 0; node < int(graph.nodeCount()); node++)
		anchored[node] |= graph.isFixed(node);
	return anchored;
}

void requireReached(const CPoseGraph& graph, const std::vector<char>& reached)
{
	for (int node = 0; node < int(graph.nodeCount()); node++)
		if (!reached[node] && graph.nodeKind(node) == ENodeKind::Pose)
			throw CError(
				"node " + std::to_string(node),
				"no chain of the given edges joins it to a fixed node or full-pose prior",
				"fix a node of its component or add the missing edge");
}
}  // namespace

void initializeFromSpanningTree(CPoseGraph& graph)
{
	std::vector<int> all(graph.edgeCount());
	std::iota(all.begin(), all.end(), 0);
	initializeFromSpanningTree(graph, all);
}

void initializeFromSpanningTree(CPoseGraph& graph, const std::vector<int>& edge_indices)
{
	const TNeighbours at = edgesAtNodes(graph, edge_indices);
	std::vector<Eigen::Isometry3d> poses = graph.poses();
	std::vector<char> reached = anchors(graph, poses);
	std::deque<int> queue;
	for (int node = 0; node < int(graph.nodeCount()); node++)
		if (reached[node]) queue.push_back(node);
	for (; !queue.empty(); queue.pop_front()) {
		const int node = queue.front();
		for (const int k : at[node]) {
			const TPoseEdge& edge = graph.edge(k);
			const int other = edge.from == node ? edge.to : edge.from;
			if (reached[other]) continue;
			poses[other] = orthonormalized(acrossEdge(graph, edge, node, poses[node]));
			reached[other] = 1;
			queue.push_back(other);
		}
	}
	requireReached(graph, reached);
	graph.setPoses(poses);
}
}  // namespace posidonia
