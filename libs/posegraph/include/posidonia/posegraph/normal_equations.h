#pragma once

#include <posidonia/posegraph/block_matrix.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/edge_residual.h>
#include <posidonia/posegraph/multifrontal_cholesky.h>

namespace posidonia
{
/** H d = b of a pose graph: H = sum w_k J_k^T Omega_k J_k, b = -sum w_k J_k^T Omega_k e_k over the free
 * nodes, in elimination order. Where each edge's blocks go is found once and kept while the structure stays.
 */
class CNormalEquations
{
   public:
	/** Follows the graph's structure; when its sparsity pattern changed, orders it and has `cholesky` analyse
	 * it. Throws CError naming a node that no chain of edges joins to a fixed node. */
	void followStructure(const CPoseGraph& graph, CMultifrontalCholesky& cholesky);

	/** Sums H and b at the graph's poses, with the weights of the robust losses there. Returns the costs. */
	TChi2 linearize(const CPoseGraph& graph);

	CBlockMatrix& H() { return m_H; }
	const CBlockMatrix& H() const { return m_H; }
	const Eigen::VectorXd& b() const { return m_b; }

	int freeNodeCount() const { return int(m_node_of_column.size()); }
	/** Block column of a node, -1 when it is fixed. */
	int columnOf(int node) const { return m_column_of_node[node]; }
	int nodeOf(int column) const { return m_node_of_column[column]; }

   private:
	/** Where an edge's blocks go. */
	struct TEdgeSlots
	{
		int from_column, to_column;	 ///< -1: fixed
		CBlockMatrix::TSlot from, to, cross;
	};

	bool sameStructure(const CPoseGraph& graph) const;
	void rememberStructure(const CPoseGraph& graph);
	void requireConnected(const CPoseGraph& graph) const;
	std::vector<CBlockMatrix::TPosition> coupledPairs(const std::vector<int>& index) const;
	void orderAndAnalyze(
		int free_count, const std::vector<CBlockMatrix::TPosition>& pairs, CMultifrontalCholesky& cholesky);
	void findSlots();
	void addEdge(const TEdgeSlots& slots, const TEdgeNormal& normal, double weight);

	std::vector<std::array<int, 2>> m_ends;	 ///< (from, to) of the edges followed
	std::vector<char> m_fixed;
	int m_ordered_count{-1};
	std::vector<CBlockMatrix::TPosition> m_ordered_pairs;  ///< pattern that was analysed, free nodes by id
	std::vector<int> m_order;
	std::vector<int> m_column_of_node, m_node_of_column;
	std::vector<TEdgeSlots> m_slots;
	CBlockMatrix m_H;
	Eigen::VectorXd m_b;
};
}  // namespace posidonia
