#include <posidonia/posegraph/partial_inverse.h>

#include <algorithm>

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
	int ld{0};
	CLargeBuffer values;
	int waiting{0};	 ///< children that have not yet read it

	void resize(int blocks, int width)
	{
		const int n = 6 * blocks;
		ld = n + width;
		values.resize(size_t(ld) * size_t(n) + size_t(width));
	}
	double* at(int row, int column) { return values.data() + size_t(column) * size_t(ld) + row; }
	const double* at(int row, int column) const { return values.data() + size_t(column) * size_t(ld) + row; }
};

class CPartialInverse
{
   public:
	CPartialInverse(const CCliqueFactor& factor, std::vector<Matrix6d>& blocks_)
		: blocks(blocks_), m_factor(factor), m_kernels(frontKernels())
	{
		const std::vector<int> cliques = factor.parentsFirst();
		if (cliques.empty()) return;
		m_parts.resize(size_t(*std::max_element(cliques.begin(), cliques.end())) + 1);
		for (const int c : cliques)
			if (factor.clique(c).parent >= 0) m_parts[factor.clique(c).parent].waiting++;
		for (const int c : cliques)
			visit(c);
	}
	std::vector<Matrix6d>& blocks;

   private:
	void visit(int c)
	{
		const auto clique = m_factor.clique(c);
		TPart& part = m_parts[c];
		part.resize(clique.blocks, m_kernels.width);
		if (clique.parent >= 0) readParent(clique, part);
		for (int J = clique.pivots - 1; J >= 0; J--)
			addColumn(clique, J, part);
		for (int J = 0; J < clique.pivots; J++)
			blocks[clique.nodes[J]] = TConstColumn(part.at(6 * J, 6 * J), 6, 6, Eigen::OuterStride<>(part.ld));
		if (part.waiting == 0) part = {};
	}

	/** The separator's part is one of the parent's. */
	void readParent(const CCliqueFactor::TClique& clique, TPart& part)
	{
		const int* rows = clique.rows_in_parent;
		TPart& parent = m_parts[clique.parent];
		const int blocks_count = clique.blocks - clique.pivots;
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
	void addColumn(const CCliqueFactor::TClique& clique, int J, TPart& part)
	{
		const int m = clique.blocks, width = m_kernels.width, n = 6 * (m - J - 1);
		const TConstColumn L(
			clique.panel + blockColumnOffset(m, J, width), 6 * (m - J), 6,
			Eigen::OuterStride<>(paddedRows(m, J, width)));
		const Matrix6d inverse =
			Matrix6d(L.topRows<6>()).triangularView<Eigen::Lower>().solve(Matrix6d::Identity());
		m_X.resize(n, 6);
		m_X.noalias() = L.bottomRows(n) * inverse;

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

	const CCliqueFactor& m_factor;
	const TFrontKernels& m_kernels;
	std::vector<TPart> m_parts;
	Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> m_X;
};
}  // namespace

void inverseDiagonalBlocks(const CCliqueFactor& factor, std::vector<Matrix6d>& blocks)
{
	CPartialInverse(factor, blocks);
}
}  // namespace posidonia
