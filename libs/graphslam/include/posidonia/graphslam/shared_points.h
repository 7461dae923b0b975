#pragma once

#include <utility>
#include <vector>

namespace posidonia
{
/** How much of its own information each stereo edge may claim when edges reuse the points of key frames
 * (README, "Shared points"). A spot of the floor measured in n key frames holds n - 1 independent
 * differences; the m edges made of it claim m. So each claims the part (n - 1) / m, and an edge's share is
 * the mean over its points. */
class CSharedPoints
{
   public:
	using TPoints = std::vector<std::pair<int, int>>;

	/** Adds edge number edgeCount(), made of `points` (point of `from`, point of `to`). */
	void addEdge(int from, int to, const TPoints& points);

	int edgeCount() const { return static_cast<int>(m_edges.size()); }
	/** In (0, 1]; 1 for an edge without points. */
	double share(int edge) const;

	/** Edges, in order, that share a spot with those added since the last call, and these themselves. */
	std::vector<int> takeTouched();

   private:
	/** A point of a key frame that edges are made of. Those of one spot form a tree of the union-find forest
	 * and a ring. */
	struct TObservation
	{
		int node;
		int parent;	 ///< Itself: root
		int next;	 ///< In the ring
		// Of roots only:
		int observations{1};
		int uses{0};  ///< By edges
	};
	struct TEdge
	{
		int from, to;
		std::vector<int> spots;	 ///< An observation of each of its points
	};

	int observationOf(int node, int point);
	int rootOf(int observation) const;
	int joined(int a, int b);
	void touchNodesOf(int observation, std::vector<char>& touched) const;

	std::vector<TEdge> m_edges;
	std::vector<std::vector<int>> m_edges_of;		   // Of each node
	std::vector<std::vector<int>> m_observation_of;	   // Of each node's points; -1: none yet
	mutable std::vector<TObservation> m_observations;  // rootOf() shortens its paths
	int m_taken{0};									   // Edges that takeTouched() has seen
};
}  // namespace posidonia
