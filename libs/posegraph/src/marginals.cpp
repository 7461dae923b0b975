#include <posidonia/base/error.h>
#include <posidonia/posegraph/marginals.h>

namespace posidonia
{
namespace
{
constexpr size_t kNodesASolve = 32;	 ///< bounds the memory of a batch: 6 * 32 columns
}

CMarginals::CMarginals(const CPoseGraph& graph, const CNormalEquations& system, CSparseCholesky& cholesky)
	: m_poses(graph.poses()),
	  m_system(&system),
	  m_cholesky(&cholesky),
	  m_factorization(cholesky.factorizations())
{
}

Matrix6d CMarginals::covarianceOf(int node) const
{
	const Eigen::MatrixXd Y = halfColumns(&node, 1);
	return Y.transpose() * Y;
}

Matrix6d CMarginals::relativeCovariance(int i, int j) const
{
	return relativeCovariances({i}, j).front();
}

std::vector<Matrix6d> CMarginals::relativeCovariances(const std::vector<int>& is, int j) const
{
	// d_ij = d_j - Ad(T_j_i) d_i, so its covariance is Z^T Z with Z = Y_j - Y_i Ad^T: positive semidefinite
	// by construction.
	const Eigen::MatrixXd Y_j = halfColumns(&j, 1);
	std::vector<Matrix6d> out;
	for (size_t first = 0; first < is.size(); first += kNodesASolve) {
		const size_t count = std::min(kNodesASolve, is.size() - first);
		const Eigen::MatrixXd Y = halfColumns(&is[first], count);
		for (size_t k = 0; k < count; k++) {
			const Matrix6d Ad = adjoint(m_poses[j].inverse() * m_poses[is[first + k]]);
			const Eigen::MatrixXd Z = Y_j - Y.middleCols<6>(6 * int(k)) * Ad.transpose();
			out.push_back(Z.transpose() * Z);
		}
	}
	return out;
}

Eigen::MatrixXd CMarginals::jointCovariance(const std::vector<int>& nodes) const
{
	const Eigen::MatrixXd Y = halfColumns(nodes.data(), nodes.size());
	return Y.transpose() * Y;
}

/** L^-1 times the nodes' unit columns, dimension x 6 count; a fixed node's are zero. */
Eigen::MatrixXd CMarginals::halfColumns(const int* nodes, size_t count) const
{
	Eigen::MatrixXd B = Eigen::MatrixXd::Zero(m_system->H().dimension(), 6 * count);
	for (size_t k = 0; k < count; k++) {
		requireUsable(nodes[k]);
		const int column = m_system->columnOf(nodes[k]);
		if (column >= 0) B.block<6, 6>(6 * column, 6 * int(k)).setIdentity();
	}
	return B.size() == 0 ? B : m_cholesky->halfSolve(B);
}

void CMarginals::requireUsable(int node) const
{
	if (m_cholesky->factorizations() != m_factorization)
		throw CError("marginals", "outdated, the optimiser was used since", "ask the optimiser again");
	if (node < 0 || node >= int(m_poses.size()))
		throw CError(
			"node " + std::to_string(node), "no such node",
			"the graph has " + std::to_string(m_poses.size()) + " nodes");
}
}  // namespace posidonia
