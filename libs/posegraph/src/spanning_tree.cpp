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
Eigen::Isometry3d acrossEdge(const TPoseEdge& edge, int node, const Eigen::Isometry3d& T_map_node)
{
	return edge.from == node ? T_map_node * edge.T_from_to : T_map_node * edge.T_from_to.inverse();
}

void requireReached(const std::vector<char>& reached)
{
	for (size_t node = 0; node < reached.size(); node++)
		if (!reached[node])
			throw CError(
				"node " + std::to_string(node), "no chain of the given edges joins it to a fixed node",
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
	std::vector<char> reached(graph.nodeCount(), 0);
	std::deque<int> queue;
	for (int node = 0; node < int(graph.nodeCount()); node++)
		if (graph.isFixed(node)) queue.push_back(node), reached[node] = 1;
	for (; !queue.empty(); queue.pop_front()) {
		const int node = queue.front();
		for (const int k : at[node]) {
			const TPoseEdge& edge = graph.edge(k);
			const int other = edge.from == node ? edge.to : edge.from;
			if (reached[other]) continue;
			poses[other] = orthonormalized(acrossEdge(edge, node, poses[node]));
			reached[other] = 1;
			queue.push_back(other);
		}
	}
	requireReached(reached);
	graph.setPoses(poses);
}
}  // namespace posidonia
