#pragma once

#include <posidonia/geometry/se3.h>
#include <posidonia/posegraph/robust_loss.h>

#include <vector>

namespace posidonia
{
/** A relative pose measured between two nodes. */
struct TPoseEdge
{
	int from{-1}, to{-1};
	Eigen::Isometry3d T_from_to{Eigen::Isometry3d::Identity()};
	/** Inverse covariance of the right perturbation (rho [m], phi [rad]) of T_from_to, so in `to`'s own frame
	 * (see geometry/se3.h). */
	Matrix6d information{Matrix6d::Identity()};
	TRobustLoss loss{};
};

/** Nodes 0 .. n-1 with their poses in the map, and the measured edges between them. Several edges may join
 * the same pair. Data only: it knows neither solver nor file. Every edge in it is valid. */
class CPoseGraph
{
   public:
	/** Returns the node's id. Throws CError when the pose is not finite or its rotation not orthonormal. */
	int addNode(const Eigen::Isometry3d& T_map_node, bool fixed = false);

	/** Returns the edge's index. Throws CError naming the edge when a node does not exist, both are the same,
	 * a number is not finite, the rotation is not orthonormal, or the information is not symmetric positive
	 * definite. */
	int addEdge(const TPoseEdge& edge);

	size_t nodeCount() const { return m_poses.size(); }
	size_t edgeCount() const { return m_edges.size(); }
	const std::vector<TPoseEdge>& edges() const { return m_edges; }
	/** Throws CError when there is no such edge. */
	const TPoseEdge& edge(int index) const;
	/** Replaces an edge between the same two nodes. Throws CError as addEdge(), and when the nodes differ. */
	void setEdge(int edge_index, const TPoseEdge& edge);
	void setLoss(int edge_index, const TRobustLoss& loss);

	/** T_map_node of every node. */
	const std::vector<Eigen::Isometry3d>& poses() const { return m_poses; }
	/** Throws CError when there is no such node. */
	const Eigen::Isometry3d& pose(int node) const;
	void setPose(int node, const Eigen::Isometry3d& T_map_node);
	/** All poses at once. @param poses as many as nodes; trusted to be rotations, as the optimiser's are. */
	void setPoses(const std::vector<Eigen::Isometry3d>& poses);

	bool isFixed(int node) const;
	void setFixed(int node, bool fixed);

   private:
	void requireNode(int node) const;

	std::vector<Eigen::Isometry3d> m_poses;
	std::vector<char> m_fixed;
	std::vector<TPoseEdge> m_edges;
};
}  // namespace posidonia
