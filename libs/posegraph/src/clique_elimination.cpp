// The arithmetic of CBayesTree: what happens inside a clique.
#include <posidonia/posegraph/bayes_tree.h>

#include <algorithm>

#include "simd/front_kernels.h"

namespace posidonia
{
namespace
{
/** A front in two pieces, as clique and parent share it: block (row, column) of the lower triangle. */
struct TFront
{
	double *panel, *rest;
	int m, pivots, width;

	struct TPlace
	{
		double* at;
		int ld;
	};
	TPlace block(int row, int column) const
	{
		const bool in_panel = column < pivots;
		double* base = in_panel ? panel + blockColumnOffset(m, column, width)
								: rest + blockColumnOffset(m - pivots, column - pivots, width);
		return {base + 6 * (row - column), paddedRows(m, column, width)};
	}
	void add(int row, int column, const Matrix6d& B) const
	{
		const auto [at, ld] = block(row, column);
		Eigen::Map<Matrix6d, 0, Eigen::OuterStride<>>(at, Eigen::OuterStride<>(ld)) += B;
	}
	/** The right-hand side is the row below the last block. */
	void addRight(int column, const Vector6d& b) const
	{
		const auto [at, ld] = block(m, column);
		for (int k = 0; k < 6; k++)
			at[size_t(k) * size_t(ld)] += b[k];
	}
};

/** A child's rest into its parent's front, when the parent's order of the separator is another than the
 * child's; only the columns of the panel, or only those of the rest. */
void addPermuted(const double* U, int blocks, const int* rows, const TFront& front, bool panel)
{
	using TBlock = Eigen::Map<const Matrix6d, 0, Eigen::OuterStride<>>;
	for (int a = 0; a < blocks; a++) {
		const double* column = U + blockColumnOffset(blocks, a, front.width);
		const Eigen::OuterStride<> stride(paddedRows(blocks, a, front.width));
		for (int b = a; b < blocks; b++) {
			const int first = std::min(rows[a], rows[b]), last = std::max(rows[a], rows[b]);
			if ((first < front.pivots) != panel) continue;
			const TBlock B(column + 6 * (b - a), stride);
			if (rows[b] >= rows[a])
				front.add(last, first, B);
			else
				front.add(last, first, B.transpose());
		}
		if ((rows[a] < front.pivots) != panel) continue;
		Vector6d right;
		for (int k = 0; k < 6; k++)
			right[k] = column[k * stride.outer() + 6 * (blocks - a)];
		front.addRight(rows[a], right);
	}
}

TFront frontOf(double* panel, double* rest, int m, int pivots, int width)
{
	return {panel, rest, m, pivots, width};
}
}  // namespace

/** The node that fails, -1 when all is well. */
int CBayesTree::eliminateClique(TClique& clique, const TNormalOf& normal_of)
{
	const int m = clique.size(), p = int(clique.pivots.size()), width = m_kernels->width;
	for (int k = 0; k < m; k++)
		m_local[k < p ? clique.pivots[k] : clique.separator[k - p]] = k;
	mapChildRows(clique);
	m_normals.clear();
	for (const int factor : clique.factors)
		m_normals.push_back(normal_of(factor));

	clique.panel.resize(frontSize(m, p, width));
	clique.rest.resize(frontSize(m - p, m - p, width));
	std::fill_n(clique.panel.data(), clique.panel.size(), 0.0);
	const TFront front = frontOf(clique.panel.data(), clique.rest.data(), m, p, width);
	sumFactors(clique, true);
	for (const int c : clique.children) {
		const TClique& child = m_cliques[c];
		if (child.rows_ascend)
			m_kernels->addToPanel(child.rest.data(), child.left(), child.rows.data(), front.panel, m, p);
		else
			addPermuted(child.rest.data(), child.left(), child.rows.data(), front, true);
	}
	const int failed = m_kernels->factorize(front.panel, m, p);
	if (failed >= 0) return clique.pivots[failed];
	m_kernels->update(front.panel, m, p, front.rest);
	sumFactors(clique, false);
	for (const int c : clique.children) {
		const TClique& child = m_cliques[c];
		if (child.rows_ascend)
			m_kernels->addToRest(child.rest.data(), child.left(), child.rows.data(), front.rest, m, p);
		else
			addPermuted(child.rest.data(), child.left(), child.rows.data(), front, false);
	}
	return -1;
}

void CBayesTree::mapChildRows(TClique& clique)
{
	for (const int c : clique.children) {
		TClique& child = m_cliques[c];
		child.rows.clear();
		for (const int node : child.separator)
			child.rows.push_back(m_local[node]);
		child.rows_ascend = std::is_sorted(child.rows.begin(), child.rows.end());
		child.rows.push_back(clique.size());
	}
}

/** The blocks of the clique's factors that belong to the panel, or those that belong to the rest. */
void CBayesTree::sumFactors(TClique& clique, bool panel)
{
	const int p = int(clique.pivots.size());
	const TFront front = frontOf(clique.panel.data(), clique.rest.data(), clique.size(), p, m_kernels->width);
	for (const TFactorNormal& normal : m_normals)
		for (int a = 0; a < normal.count; a++) {
			const int row = m_local[normal.node[a]];
			if ((row < p) == panel) front.addRight(row, -normal.g[a]);
			for (int b = 0; b <= a; b++) {
				const int column = m_local[normal.node[b]];
				const Matrix6d& H = normal.H[TFactorNormal::lower(a, b)];
				if ((std::min(row, column) < p) != panel) continue;
				if (row >= column)
					front.add(row, column, H);
				else
					front.add(column, row, H.transpose());
			}
		}
}

const std::vector<int>& CBayesTree::solve(const Vector6d& tolerance, std::vector<Vector6d>& d)
{
	m_solved.clear();
	// Fresh cliques, parents first; then their orphans, and down as far as something changes.
	for (auto c = m_fresh.rbegin(); c != m_fresh.rend(); ++c)
		solveClique(m_cliques[*c], d);
	m_fresh.clear();
	for (size_t k = 0; k < m_adopted.size(); k++) {
		const TClique& clique = m_cliques[m_adopted[k]];
		const bool reached = std::any_of(
			clique.separator.begin(), clique.separator.end(), [&](int node) { return m_changed[node]; });
		if (reached && wouldChange(clique, tolerance, d)) {
			take(clique, d);
			m_adopted.insert(m_adopted.end(), clique.children.begin(), clique.children.end());
		}
	}
	m_adopted.clear();
	for (const int node : m_solved)
		m_changed[node] = 0;
	return m_solved;
}

/** Back-substitution into m_x: first the pivots, then the separator. */
void CBayesTree::backSubstitute(const TClique& clique, const std::vector<Vector6d>& d)
{
	const int m = clique.size(), p = int(clique.pivots.size());
	if (int(m_x.size()) < 6 * m) m_x.resize(6 * size_t(m));
	for (int k = p; k < m; k++)
		std::copy_n(d[clique.separator[k - p]].data(), 6, &m_x[6 * size_t(k)]);
	m_kernels->backSubstitute(clique.panel.data(), m, p, m_x.data());
}

void CBayesTree::take(const TClique& clique, std::vector<Vector6d>& d)
{
	for (size_t k = 0; k < clique.pivots.size(); k++) {
		const int node = clique.pivots[k];
		d[node] = Eigen::Map<const Vector6d>(&m_x[6 * k]);
		m_changed[node] = 1;
		m_solved.push_back(node);
	}
}

void CBayesTree::solveClique(const TClique& clique, std::vector<Vector6d>& d)
{
	backSubstitute(clique, d);
	take(clique, d);
}

/** Does a coordinate change by more than the tolerance? When none does, the old solution is kept, so that
 * small changes cannot add up unseen. */
bool CBayesTree::wouldChange(const TClique& clique, const Vector6d& tolerance, const std::vector<Vector6d>& d)
{
	backSubstitute(clique, d);
	for (size_t k = 0; k < clique.pivots.size(); k++) {
		const Vector6d change = Eigen::Map<const Vector6d>(&m_x[6 * k]) - d[clique.pivots[k]];
		if ((change.array().abs() > tolerance.array()).any()) return true;
	}
	return false;
}
}  // namespace posidonia
