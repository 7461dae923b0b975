#include <posidonia/base/error.h>
#include <posidonia/posegraph/marginals.h>
#include <posidonia/posegraph/partial_inverse.h>

#include "simd/front_kernels.h"

namespace posidonia
{
CMarginals::CMarginals(
	const CPoseGraph& graph, const CNormalEquations& system, const CMultifrontalCholesky& cholesky)
	: m_poses(graph.poses()),
	  m_system(&system),
	  m_cholesky(&cholesky),
	  m_factorization(cholesky.factorizations())
{
}

Matrix6d CMarginals::covarianceOf(int node) const
{
	const THalfColumns Y = halfColumns(node);
	return product(Y, Y);
}

std::vector<Matrix6d> CMarginals::allCovariances() const
{
	std::vector<Matrix6d> out(m_poses.size(), Matrix6d::Zero());
	if (out.empty()) return out;
	requireUsable(0);
	const auto blocks = inverseDiagonalBlocks(*m_cholesky);
	for (size_t column = 0; column < blocks.size(); column++)
		out[m_system->nodeOf(int(column))] = blocks[column];
	return out;
}

Matrix6d CMarginals::relativeCovariance(int i, int j) const
{
	return relativeCovariances({i}, j).front();
}

std::vector<Matrix6d> CMarginals::relativeCovariances(const std::vector<int>& is, int j) const
{
	const THalfColumns Y_j = halfColumns(j);
	const Matrix6d S_jj = product(Y_j, Y_j);
	std::vector<Matrix6d> out;
	out.reserve(is.size());
	for (const int i : is) {
		// d_ij = d_j - Ad(T_j_i) d_i
		const THalfColumns Y_i = halfColumns(i);
		const Matrix6d Ad = adjoint(m_poses[j].inverse() * m_poses[i]);
		const Matrix6d cross = Ad * product(Y_i, Y_j);
		const Matrix6d S = S_jj + Ad * product(Y_i, Y_i) * Ad.transpose() - cross - cross.transpose();
		out.push_back(0.5 * (S + S.transpose()));
	}
	return out;
}

Eigen::MatrixXd CMarginals::jointCovariance(const std::vector<int>& nodes) const
{
	const int count = int(nodes.size());
	std::vector<THalfColumns> Y;
	for (const int node : nodes)
		Y.push_back(halfColumns(node));
	Eigen::MatrixXd S(6 * count, 6 * count);
	for (int a = 0; a < count; a++)
		for (int b = 0; b <= a; b++) {
			S.block<6, 6>(6 * a, 6 * b) = product(Y[a], Y[b]);
			S.block<6, 6>(6 * b, 6 * a) = S.block<6, 6>(6 * a, 6 * b).transpose();
		}
	return S;
}

/** Forward substitution, which starts in the node's own clique and touches only those above it. */
CMarginals::THalfColumns CMarginals::halfColumns(int node) const
{
	requireUsable(node);
	THalfColumns out;
	const int column = m_system->columnOf(node);
	if (column < 0) return out;
	const auto& forest = m_cholesky->forest();
	const int width = m_cholesky->kernels().width;
	TColumns r, next;
	for (int c = forest.clique_of[column]; c >= 0; c = forest.cliques[c].parent) {
		const auto& clique = forest.cliques[c];
		const int m = clique.size(), p = clique.pivots;
		if (out.cliques.empty()) {
			r.setZero(6 * m, 6);
			r.middleRows<6>(6 * (column - clique.first)).setIdentity();
		}
		for (int J = 0; J < p; J++) {
			const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> L(
				m_cholesky->panel(c) + blockColumnOffset(m, J, width), 6 * (m - J), 6,
				Eigen::OuterStride<>(paddedRows(m, J, width)));
			const Matrix6d y = Matrix6d(L.topRows<6>())
								   .triangularView<Eigen::Lower>()
								   .solve(Matrix6d(r.middleRows<6>(6 * J)));
			r.middleRows<6>(6 * J) = y;
			r.bottomRows(6 * (m - J - 1)).noalias() -= L.bottomRows(6 * (m - J - 1)) * y;
		}
		out.cliques.push_back(c);
		out.values.push_back(r.topRows(6 * p));
		if (clique.parent < 0) break;
		const int* rows = m_cholesky->rowsInParent(c);
		next.setZero(6 * forest.cliques[clique.parent].size(), 6);
		for (int b = 0; b < m - p; b++)
			next.middleRows<6>(6 * rows[b]) = r.middleRows<6>(6 * (p + b));
		r.swap(next);
	}
	return out;
}

/** Y_a^T Y_b: only the cliques above both count. */
Matrix6d CMarginals::product(const THalfColumns& a, const THalfColumns& b)
{
	Matrix6d sum = Matrix6d::Zero();
	// From the root down, as long as the ways are one.
	auto i = a.cliques.size(), j = b.cliques.size();
	while (i > 0 && j > 0 && a.cliques[i - 1] == b.cliques[j - 1]) {
		i--, j--;
		sum.noalias() += a.values[i].transpose() * b.values[j];
	}
	return sum;
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
