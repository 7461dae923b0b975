#pragma once

#include <posidonia/posegraph/pose_graph.h>

#include <algorithm>

namespace posidonia::testing
{
/** A finished graph arrives node by node, each with the factors that need no later one; a new pose where its
 * first edge puts it from the present estimate, as a survey's does. */
class CArrival
{
   public:
	explicit CArrival(const CPoseGraph& whole)
		: m_whole(whole),
		  m_edges(whole.nodeCount()),
		  m_priors(whole.nodeCount()),
		  m_own(whole.nodeCount(), -1)
	{
		for (size_t k = 0; k < whole.edgeCount(); k++) {
			const TPoseEdge& edge = whole.edges()[k];
			m_edges[size_t(std::max({edge.from, edge.to, edge.error_variable}))].push_back(int(k));
		}
		for (size_t k = 0; k < whole.priorCount(); k++) {
			const TPosePrior& prior = whole.priors()[k];
			if (prior.kind == EPriorKind::ErrorVariable)
				m_own[size_t(prior.node)] = int(k);
			else
				m_priors[size_t(std::max(prior.node, prior.error_variable))].push_back(int(k));
		}
	}

	CPoseGraph graph;

	bool more() const { return graph.nodeCount() < m_whole.nodeCount(); }

	/** The next node without its factors. */
	int addNodeAlone()
	{
		const int node = int(graph.nodeCount());
		if (m_whole.nodeKind(node) == ENodeKind::ErrorVariable) {
			const TPosePrior& own = m_whole.prior(m_own[size_t(node)]);
			return graph.addErrorVariable(own.value, own.information);
		}
		return graph.addNode(poseOnArrival(node), m_whole.isFixed(node));
	}

	void addFactorsOf(int node)
	{
		for (const int k : m_edges[size_t(node)])
			graph.addEdge(m_whole.edge(k));
		for (const int k : m_priors[size_t(node)])
			graph.addPrior(m_whole.prior(k));
	}

	int addNode()
	{
		const int node = addNodeAlone();
		addFactorsOf(node);
		return node;
	}

   private:
	Eigen::Isometry3d poseOnArrival(int node) const
	{
		if (m_whole.isFixed(node)) return m_whole.pose(node);
		for (const int k : m_edges[size_t(node)]) {
			const TPoseEdge& edge = m_whole.edge(k);
			if (edge.to == node) return orthonormalized(graph.pose(edge.from) * edge.T_from_to);
			if (edge.from == node) return orthonormalized(graph.pose(edge.to) * edge.T_from_to.inverse());
		}
		return m_whole.pose(node);
	}

	const CPoseGraph& m_whole;
	std::vector<std::vector<int>> m_edges, m_priors;  ///< of each node
	std::vector<int> m_own;							  ///< prior of each error variable
};
}  // namespace posidonia::testing
