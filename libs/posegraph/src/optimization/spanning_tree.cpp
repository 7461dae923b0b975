#include <posidonia/posegraph/spanning_tree.h>

#include <deque>
#include <numeric>

#include "graph/anchors.h"

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
	const Eigen::Isometry3d T_from_to = presentMeasurement(graph, edge);
	return edge.from == node ? T_map_node * T_from_to : T_map_node * T_from_to.inverse();
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
