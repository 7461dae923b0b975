#pragma once

#include <posidonia/posegraph/node_states.h>
#include <posidonia/posegraph/pose_edge.h>
#include <posidonia/posegraph/pose_prior.h>

#include <string>
#include <vector>

namespace posidonia
{
/** Nodes 0 .. n-1 (poses in the map, and error variables, in one numbering), and two lists of factors: edges
 * between poses, priors of one node. Several may speak of the same nodes. Indices never change. Data only: it
 * knows neither solver nor file. Every factor in it is valid. */
class CPoseGraph
{
   public:
	/** Returns the node's id. Throws CError when the pose is not finite or its rotation not orthonormal. */
	int addNode(const Eigen::Isometry3d& T_map_node, bool fixed = false);

	/** Adds a node for an error that many factors share, at `value`, and its prior around that value, so that
	 * no component of it is ever undetermined; what no factor uses stays there. Returns the node's id. Throws
	 * CError when a number is not finite or the information not symmetric positive definite. */
	int addErrorVariable(const Vector6d& value, const Matrix6d& prior_information);

	/** Returns the edge's index. Throws CError naming the edge when a node does not exist, both are the same,
	 * a number is not finite, the rotation is not orthonormal, or the information is not symmetric positive
	 * definite. */
	int addEdge(const TPoseEdge& edge);

	/** Returns the prior's index. Throws CError naming prior and node for the like reasons. */
	int addPrior(const TPosePrior& prior);

	/** The same nodes and priors with these edges alone, numbered in this order. Throws CError when there is
	 * no such edge. */
	CPoseGraph withEdges(const std::vector<int>& indices) const;

	size_t nodeCount() const { return m_states.poses.size(); }
	size_t edgeCount() const { return m_edges.size(); }
	size_t priorCount() const { return m_priors.size(); }
	const std::vector<TPoseEdge>& edges() const { return m_edges; }
	const std::vector<TPosePrior>& priors() const { return m_priors; }
	/** Throws CError when there is no such edge. */
	const TPoseEdge& edge(int index) const;
	const TPosePrior& prior(int index) const;
	/** Replaces an edge between the same nodes (error variable included). Throws CError as addEdge(), and
	 * when the nodes differ. */
	void setEdge(int edge_index, const TPoseEdge& edge);
	/** Replaces a prior of the same kind and nodes. Throws CError as addPrior(), and when these differ. */
	void setPrior(int prior_index, const TPosePrior& prior);
	void setLoss(int edge_index, const TRobustLoss& loss);
	void setPriorLoss(int prior_index, const TRobustLoss& loss);

	ENodeKind nodeKind(int node) const;
	/** Values of all nodes. */
	const TNodeStates& states() const { return m_states; }
	/** T_map_node of every node; the identity for error variables. */
	const std::vector<Eigen::Isometry3d>& poses() const { return m_states.poses; }
	/** Throws CError when there is no such node. */
	const Eigen::Isometry3d& pose(int node) const;
	const Vector6d& errorVariable(int node) const;
	void setPose(int node, const Eigen::Isometry3d& T_map_node);
	void setErrorVariable(int node, const Vector6d& value);
	/** All at once. @param poses as many as nodes; trusted to be rotations, as the optimiser's are. */
	void setPoses(const std::vector<Eigen::Isometry3d>& poses);
	void setStates(const TNodeStates& states);

	bool isFixed(int node) const;
	void setFixed(int node, bool fixed);

   private:
	int addNode(ENodeKind kind, const Eigen::Isometry3d& T_map_node, const Vector6d& value, bool fixed);
	void requireNode(int node) const;
	void requireKind(int node, ENodeKind kind) const;
	bool isNode(int node, ENodeKind kind) const;
	const char* edgeProblem(const TPoseEdge& edge) const;
	const char* priorProblem(const TPosePrior& prior) const;

	TNodeStates m_states;
	std::vector<ENodeKind> m_kinds;
	std::vector<char> m_fixed;
	std::vector<TPoseEdge> m_edges;
	std::vector<TPosePrior> m_priors;
};

/** "node 7 (edges 6, 9; priors 2)", at most `limit` of each: for messages. */
std::string describeNode(const CPoseGraph& graph, int node, int limit = 8);
}  // namespace posidonia
