#include <posidonia/apps/graph_replay.h>
#include <posidonia/base/error.h>

#include <algorithm>

namespace posidonia
{
namespace
{
int olderEnd(const TPoseEdge& edge)
{
	return std::min(edge.from, edge.to);
}
int newerEnd(const TPoseEdge& edge)
{
	return std::max(edge.from, edge.to);
}
}  // namespace

CGraphReplay::CGraphReplay(const CPoseGraph& whole) : m_whole(whole), m_edges_of(whole.nodeCount())
{
	for (size_t k = 0; k < whole.edgeCount(); k++)
		m_edges_of[static_cast<size_t>(newerEnd(whole.edges()[k]))].push_back(static_cast<int>(k));
	for (size_t node = 0; node < whole.nodeCount(); node++)
		if (m_edges_of[node].empty() && !whole.isFixed(static_cast<int>(node)))
			throw CError(
				"node " + std::to_string(node), "is neither fixed nor has an edge to an older node",
				"such a graph can't be played node by node; optimise it at once");
}

bool CGraphReplay::addNext(CPoseGraph& growing)
{
	const int node = m_next++;
	growing.addNode(startPose(node, growing), m_whole.isFixed(node));
	bool closed = false;
	for (const int k : m_edges_of[static_cast<size_t>(node)]) {
		growing.addEdge(m_whole.edge(k));
		m_edge_order.push_back(k);
		closed |= olderEnd(m_whole.edge(k)) < node - 1;
	}
	return closed;
}

/** Across the edge from the youngest node: the odometry, where there is one. */
Eigen::Isometry3d CGraphReplay::startPose(int node, const CPoseGraph& growing) const
{
	if (m_whole.isFixed(node)) return m_whole.pose(node);
	const auto& edges = m_edges_of[static_cast<size_t>(node)];
	const auto& edge = m_whole.edge(*std::max_element(edges.begin(), edges.end(), [&](int a, int b) {
		return olderEnd(m_whole.edge(a)) < olderEnd(m_whole.edge(b));
	}));
	const Eigen::Isometry3d T_old_new = edge.to == node ? edge.T_from_to : edge.T_from_to.inverse();
	return orthonormalized(growing.pose(olderEnd(edge)) * T_old_new);
}
}  // namespace posidonia
