#pragma once

#include <posidonia/posegraph/pose_graph.h>

#include <vector>

namespace posidonia
{
/** Plays a whole graph as it would have arrived: node by node in ascending order, each with its edges to
 * older nodes, its start pose composed onto the present estimate. */
class CGraphReplay
{
   public:
	/** @param whole must outlive this. Throws CError naming a node that is neither fixed nor has an edge to
	 * an older node. */
	explicit CGraphReplay(const CPoseGraph& whole);

	bool done() const { return m_next == static_cast<int>(m_whole.nodeCount()); }

	/** Appends the next node and its edges to `growing`. True when an edge leads to a node older than the one
	 * before it: a loop closed. */
	bool addNext(CPoseGraph& growing);

	/** The whole graph's index of each edge of the grown graph. */
	const std::vector<int>& edgeOrder() const { return m_edge_order; }

   private:
	Eigen::Isometry3d startPose(int node, const CPoseGraph& growing) const;

	const CPoseGraph& m_whole;
	std::vector<std::vector<int>> m_edges_of;  ///< Of each node, the edges whose higher end it is
	std::vector<int> m_edge_order;
	int m_next{0};
};
}  // namespace posidonia
