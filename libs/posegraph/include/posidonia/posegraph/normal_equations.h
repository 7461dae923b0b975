#pragma once

#include <posidonia/posegraph/block_matrix.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/factor_normal.h>
#include <posidonia/posegraph/graph_structure.h>
#include <posidonia/posegraph/multifrontal_cholesky.h>

namespace posidonia
{
/** H d = b of a pose graph: H = sum w_k J_k^T Omega_k J_k, b = -sum w_k J_k^T Omega_k e_k over all factors
 * and the free nodes, in elimination order. Where each factor's blocks go is found once and kept while the
 * structure stays. */
class CNormalEquations
{
   public:
	/** Follows the graph's structure; when its sparsity pattern changed, orders it and has `cholesky` analyse
	 * it. Throws CError naming a node that neither a fixed node nor priors hold. */
	void followStructure(const CPoseGraph& graph, CMultifrontalCholesky& cholesky);

	/** Sums H and b at the graph's states, with the weights of the robust losses there. Returns the costs. */
	TChi2 linearize(const CPoseGraph& graph);

	CBlockMatrix& H() { return m_H; }
	const CBlockMatrix& H() const { return m_H; }
	const Eigen::VectorXd& b() const { return m_b; }

	int freeNodeCount() const { return int(m_node_of_column.size()); }
	/** Block column of a node, -1 when it is fixed. */
	int columnOf(int node) const { return m_column_of_node[node]; }
	int nodeOf(int column) const { return m_node_of_column[column]; }
	const std::vector<int>& nodesOfColumns() const { return m_node_of_column; }

   private:
	/** Where a factor's blocks go. */
	struct TFactorSlots
	{
		int count;
		int column[3];				  ///< -1: fixed
		CBlockMatrix::TSlot slot[6];  ///< as TFactorNormal::H
	};

	std::vector<CBlockMatrix::TPosition> coupledFreePairs(size_t node_count) const;
	void orderAndAnalyze(
		int free_count, const std::vector<CBlockMatrix::TPosition>& pairs, CMultifrontalCholesky& cholesky);
	void nameColumns(size_t node_count);
	void findSlots();
	TFactorSlots slotsOf(const TFactorNodes& nodes) const;
	void add(const TFactorSlots& slots, const TFactorNormal& normal, const TRobustLoss& loss, TChi2& sum);

	CGraphStructure m_structure;
	bool m_ready{false};  ///< does all below belong to m_structure?
	int m_ordered_count{-1};
	std::vector<CBlockMatrix::TPosition> m_ordered_pairs;  ///< pattern that was analysed, free nodes by id
	std::vector<int> m_order;
	std::vector<int> m_column_of_node, m_node_of_column;
	std::vector<TFactorSlots> m_edge_slots, m_prior_slots;
	CBlockMatrix m_H;
	Eigen::VectorXd m_b;
};
}  // namespace posidonia
