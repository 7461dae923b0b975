#include <posidonia/posegraph/partial_inverse.h>

#include <algorithm>

#include "elimination/simd/front_kernels.h"

namespace posidonia
{
namespace
{
using TConstColumn = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using TColumn = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/** A clique's part of the inverse, square and symmetric, with room after the last column for a whole vector.
 */
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

constexpr int kGroup = 8;  ///< pivots at a time, so that the large part is read seldom

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
		for (int last = clique.pivots; last > 0; last -= kGroup)
			addGroup(clique, std::max(0, last - kGroup), last, part);
		for (int J = 0; J < clique.pivots; J++)
			blocks[clique.nodes[J]] =
				TConstColumn(part.at(6 * J, 6 * J), 6, 6, Eigen::OuterStride<>(part.ld));
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

	/** With G the pivots [first, last) and B all rows below them, X = L_BG L_GG^-1:
	 * S_BG = -S_BB X and S_GG = (L_GG L_GG^T)^-1 - X^T S_BG. */
	void addGroup(const CCliqueFactor::TClique& clique, int first, int last, TPart& part)
	{
		const int groups = last - first, g = 6 * groups, n = 6 * (clique.blocks - last),
				  width = m_kernels.width;
		readGroup(clique, first, last);
		const Eigen::MatrixXd inverse = m_L_GG.topRows(g).leftCols(g).triangularView<Eigen::Lower>().solve(
			Eigen::MatrixXd::Identity(g, g));
		const int ld = n + width;
		m_minus_X.resize(size_t(ld) * size_t(g) + size_t(width));
		packGroups(inverse.data(), g, g, groups, 1, m_packed);
		m_kernels.multiply(m_L_BG.data(), ld, n, g, m_packed.data(), m_minus_X.data(), ld, groups);

		double* S_BG = part.at(6 * last, 6 * first);
		packGroups(m_minus_X.data(), ld, n, groups, -1, m_packed);
		m_kernels.multiply(
			part.at(6 * last, 6 * last), part.ld, n, n, m_packed.data(), S_BG, part.ld, groups);
		mirror(S_BG, part.ld, n, g, part.at(6 * first, 6 * last));

		m_S_GG.noalias() = inverse.transpose() * inverse;
		subtractProduct(n, groups, S_BG, part.ld);
		TColumn(part.at(6 * first, 6 * first), g, g, Eigen::OuterStride<>(part.ld)) =
			0.5 * (m_S_GG + m_S_GG.transpose());
	}

	/** S_GG -= X^T S_BG. X as packed is, six columns at a time, X^T column by column. */
	void subtractProduct(int n, int groups, const double* S_BG, int ld)
	{
		const int g = 6 * groups, ld_product = g + m_kernels.width;
		packGroups(S_BG, ld, n, groups, 1, m_packed_S);
		m_product.resize(size_t(ld_product) * size_t(g) + size_t(m_kernels.width));
		for (int q = 0; q < groups; q++)  // the vector beyond six rows is overwritten by the next
			m_kernels.multiply(
				m_packed.data() + size_t(6 * q) * size_t(n), 6, 6, n, m_packed_S.data(),
				m_product.data() + 6 * q, ld_product, groups);
		m_S_GG += TConstColumn(m_product.data(), g, g, Eigen::OuterStride<>(ld_product));
	}

	/** L_GG as a square, L_BG with room for a whole vector. */
	void readGroup(const CCliqueFactor::TClique& clique, int first, int last)
	{
		const int m = clique.blocks, width = m_kernels.width, n = 6 * (m - last), ld = n + width;
		m_L_GG.setZero(6 * (last - first), 6 * (last - first));
		m_L_BG.resize(size_t(ld) * size_t(6 * (last - first)) + size_t(width));
		for (int J = first; J < last; J++) {
			const TConstColumn L(
				clique.panel + blockColumnOffset(m, J, width), 6 * (m - J), 6,
				Eigen::OuterStride<>(paddedRows(m, J, width)));
			const int above = 6 * (last - J);
			m_L_GG.block(6 * (J - first), 6 * (J - first), above, 6) = L.topRows(above);
			TColumn(m_L_BG.data() + size_t(ld) * size_t(6 * (J - first)), n, 6, Eigen::OuterStride<>(ld)) =
				L.bottomRows(n);
		}
	}

	/** Columns, times `sign`, in groups of six, each row by row; with room for a whole vector. */
	void packGroups(const double* A, int lda, int rows, int groups, double sign, CLargeBuffer& packed) const
	{
		packed.resize(6 * size_t(rows) * size_t(groups) + size_t(m_kernels.width));
		double* to = packed.data();
		for (int g = 0; g < groups; g++, to += 6 * rows)
			for (int c = 0; c < 6; c++)
				for (int r = 0; r < rows; r++)
					to[6 * r + c] = sign * A[size_t(6 * g + c) * size_t(lda) + size_t(r)];
		std::fill_n(to, m_kernels.width, 0.0);
	}

	/** The transpose of A (rows x columns) to `to`, which has the same distance between columns. */
	static void mirror(const double* A, int ld, int rows, int columns, double* to)
	{
		for (int r = 0; r < rows; r++)
			for (int c = 0; c < columns; c++)
				to[size_t(r) * size_t(ld) + c] = A[size_t(c) * size_t(ld) + r];
	}

	const CCliqueFactor& m_factor;
	const TFrontKernels& m_kernels;
	std::vector<TPart> m_parts;
	CLargeBuffer m_L_BG, m_minus_X, m_packed, m_packed_S, m_product;
	Eigen::MatrixXd m_L_GG, m_S_GG;
};
}  // namespace

void inverseDiagonalBlocks(const CCliqueFactor& factor, std::vector<Matrix6d>& blocks)
{
	CPartialInverse(factor, blocks);
}
}  // namespace posidonia
