#include <posidonia/posegraph/partial_inverse.h>

#include "simd/front_kernels.h"

namespace posidonia
{
namespace
{
using TConstColumn = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using TColumn = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/** A clique's part of the inverse, square and symmetric, with room after the last column for a whole vector. */
struct TPart
{
	int n{0}, ld{0};
	std::vector<double> values;
	int waiting{0};	 ///< children that have not yet read it

	void resize(int blocks, int width)
	{
		n = 6 * blocks;
		ld = n + width;
		values.resize(size_t(ld) * size_t(n) + size_t(width));
	}
	double* at(int row, int column) { return values.data() + size_t(column) * size_t(ld) + row; }
	const double* at(int row, int column) const { return values.data() + size_t(column) * size_t(ld) + row; }
};

class CPartialInverse
{
   public:
	explicit CPartialInverse(const CMultifrontalCholesky& cholesky)
		: m_cholesky(cholesky),
		  m_forest(cholesky.forest()),
		  m_kernels(cholesky.kernels()),
		  m_parts(m_forest.cliques.size())
	{
		blocks.resize(m_forest.order.size());
		for (int c = int(m_parts.size()) - 1; c >= 0; c--)
			visit(c);
	}
	std::vector<Matrix6d> blocks;

   private:
	void visit(int c)
	{
		const auto& clique = m_forest.cliques[c];
		TPart& part = m_parts[c];
		part.resize(clique.size(), m_kernels.width);
		part.waiting = int(clique.children.size());
		if (clique.parent >= 0) readParent(c);
		for (int J = clique.pivots - 1; J >= 0; J--)
			addColumn(c, J);
		for (int J = 0; J < clique.pivots; J++)
			blocks[clique.first + J] = TConstColumn(part.at(6 * J, 6 * J), 6, 6, Eigen::OuterStride<>(part.ld));
		if (part.waiting == 0) part = {};
	}

	/** The separator's part is one of the parent's. */
	void readParent(int c)
	{
		const auto& clique = m_forest.cliques[c];
		const int* rows = m_cholesky.rowsInParent(c);
		TPart &part = m_parts[c], &parent = m_parts[clique.parent];
		const int blocks_count = int(clique.separator.size());
		for (int a = 0; a < blocks_count; a++)
			for (int k = 0; k < 6; k++) {
				double* to = part.at(6 * clique.pivots, 6 * (clique.pivots + a) + k);
				const double* from = parent.at(0, 6 * rows[a] + k);
				for (int b = 0; b < blocks_count; b++, to += 6)
					std::copy_n(from + 6 * rows[b], 6, to);
			}
		if (--parent.waiting == 0) parent = {};
	}

	/** With B the rows below pivot J: S_BJ = -S_BB X and S_JJ = (L_JJ L_JJ^T)^-1 - X^T S_BJ, X = L_BJ L_JJ^-1. */
	void addColumn(int c, int J)
	{
		const int m = m_forest.cliques[c].size(), width = m_kernels.width, n = 6 * (m - J - 1);
		const TConstColumn L(
			m_cholesky.panel(c) + blockColumnOffset(m, J, width), 6 * (m - J), 6,
			Eigen::OuterStride<>(paddedRows(m, J, width)));
		const Matrix6d inverse =
			Matrix6d(L.topRows<6>()).triangularView<Eigen::Lower>().solve(Matrix6d::Identity());
		m_X.resize(n, 6);
		m_X.noalias() = L.bottomRows(n) * inverse;

		TPart& part = m_parts[c];
		TColumn S_BJ(part.at(6 * (J + 1), 6 * J), n, 6, Eigen::OuterStride<>(part.ld));
		m_kernels.multiply(
			part.at(6 * (J + 1), 6 * (J + 1)), part.ld, n, n, m_X.data(), part.at(6 * (J + 1), 6 * J), part.ld);
		TColumn S_JJ(part.at(6 * J, 6 * J), 6, 6, Eigen::OuterStride<>(part.ld));
		const Matrix6d S = inverse.transpose() * inverse - m_X.transpose() * S_BJ;
		S_JJ = 0.5 * (S + S.transpose());
		for (int k = 0; k < n; k++)
			for (int i = 0; i < 6; i++)
				*part.at(6 * J + i, 6 * (J + 1) + k) = S_BJ(k, i);
	}

	const CMultifrontalCholesky& m_cholesky;
	const TEliminationForest& m_forest;
	const TFrontKernels& m_kernels;
	std::vector<TPart> m_parts;
	Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> m_X;
};
}  // namespace

std::vector<Matrix6d> inverseDiagonalBlocks(const CMultifrontalCholesky& cholesky)
{
	return std::move(CPartialInverse(cholesky).blocks);
}
}  // namespace posidonia
