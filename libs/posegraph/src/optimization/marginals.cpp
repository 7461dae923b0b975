#include <posidonia/base/error.h>
#include <posidonia/posegraph/marginals.h>
#include <posidonia/posegraph/partial_inverse.h>

#include <algorithm>

#include "elimination/simd/front_kernels.h"

namespace posidonia
{
Matrix6d CMarginals::covarianceOf(int node) const
{
	const THalfColumns Y = halfColumns(node);
	return product(Y, Y);
}

std::vector<Matrix6d> CMarginals::allCovariances() const
{
	std::vector<Matrix6d> out(m_poses->size(), Matrix6d::Zero());
	if (out.empty()) return out;
	requireUsable(0);
	inverseDiagonalBlocks(*m_factor, out);
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
		const Matrix6d Ad = adjoint((*m_poses)[j].inverse() * (*m_poses)[i]);
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
	const int width = frontKernels().width;
	TColumns r, next;
	for (int c = m_factor->cliqueOf(node); c >= 0;) {
		const auto clique = m_factor->clique(c);
		const int m = clique.blocks, p = clique.pivots;
		if (out.cliques.empty()) {
			r.setZero(6 * m, 6);
			r.middleRows<6>(6 * (std::find(clique.nodes, clique.nodes + p, node) - clique.nodes))
				.setIdentity();
		}
		for (int J = 0; J < p; J++) {
			const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> L(
				clique.panel + blockColumnOffset(m, J, width), 6 * (m - J), 6,
				Eigen::OuterStride<>(paddedRows(m, J, width)));
			const Matrix6d y = Matrix6d(L.topRows<6>())
								   .triangularView<Eigen::Lower>()
								   .solve(Matrix6d(r.middleRows<6>(6 * J)));
			r.middleRows<6>(6 * J) = y;
			r.bottomRows(6 * (m - J - 1)).noalias() -= L.bottomRows(6 * (m - J - 1)) * y;
		}
		out.cliques.push_back(c);
		out.values.push_back(r.topRows(6 * p));
		c = clique.parent;
		if (c < 0) break;
		next.setZero(6 * m_factor->clique(c).blocks, 6);
		for (int b = 0; b < m - p; b++)
			next.middleRows<6>(6 * clique.rows_in_parent[b]) = r.middleRows<6>(6 * (p + b));
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
	if (m_factor->version() != m_version)
		throw CError("marginals", "outdated, the optimiser was used since", "ask the optimiser again");
	if (node < 0 || node >= int(m_poses->size()))
		throw CError(
			"node " + std::to_string(node), "no such node",
			"the graph has " + std::to_string(m_poses->size()) + " nodes");
}
}  // namespace posidonia
