// The arithmetic of CBayesTree: what happens inside a clique.
#include <posidonia/posegraph/bayes_tree.h>

#include <algorithm>
#include <limits>

#include "elimination/simd/front_kernels.h"

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
}  // namespace

/** The node that fails, -1 when all is well. */
int CBayesTree::eliminateClique(TClique& clique, CFactorSource& factors)
{
	const int m = clique.size(), p = int(clique.pivots.size());
	for (const int factor : clique.factors)
		factors.weighAnew(factor);
	takeFactors(clique, factors);
	mapChildRows(clique);
	clique.panel.resize(frontSize(m, p, m_kernels->width));
	std::fill_n(clique.panel.data(), clique.panel.size(), 0.0);
	sumFactors(clique, true);
	sumChildren(clique, true);
	const int failed = m_kernels->factorize(clique.panel.data(), m, p);
	if (failed >= 0) return clique.pivots[failed];
	sumRest(clique);
	return -1;
}

/** The places of the clique's nodes in its front, its factors' normal equations. */
void CBayesTree::takeFactors(TClique& clique, const CFactorSource& factors)
{
	int place = 0;
	for (const int node : clique.pivots)
		m_local[node] = place++;
	for (const int node : clique.separator)
		m_local[node] = place++;
	m_normals.clear();
	for (const int factor : clique.factors)
		m_normals.push_back(factors.normalOf(factor));
}

/** What the clique, whose panel is eliminated, leaves to its parent. */
void CBayesTree::sumRest(TClique& clique)
{
	const int m = clique.size(), p = int(clique.pivots.size());
	clique.rest.resize(frontSize(m - p, m - p, m_kernels->width));
	clique.has_rest = true;
	m_kernels->update(clique.panel.data(), m, p, clique.rest.data());
	sumFactors(clique, false);
	sumChildren(clique, false);
}

/** What the children leave, into the panel or into the rest. */
void CBayesTree::sumChildren(TClique& clique, bool panel)
{
	const int m = clique.size(), p = int(clique.pivots.size());
	const TFront front{clique.panel.data(), clique.rest.data(), m, p, m_kernels->width};
	const auto add = panel ? m_kernels->addToPanel : m_kernels->addToRest;
	for (const int c : clique.children) {
		const TClique& child = m_cliques[c];
		if (child.rows_ascend)
			add(child.rest.data(), child.left(), child.rows.data(), panel ? front.panel : front.rest, m, p);
		else
			addPermuted(child.rest.data(), child.left(), child.rows.data(), front, panel);
	}
}

/** The rests that these cliques have dropped, from those still kept below; the ones between are dropped again
 * at once. Nothing below has changed since: neither linearisation nor weights. */
void CBayesTree::recoverRests(const std::vector<int>& orphans, const CFactorSource& factors)
{
	std::vector<int> missing, stack;  // missing: parents before children, subtree by subtree
	for (const int orphan : orphans)
		if (!m_cliques[orphan].has_rest) stack.push_back(orphan);
	for (const int orphan : stack)
		m_by_age.push_back({orphan, m_cliques[orphan].made, m_version});
	while (!stack.empty()) {
		missing.push_back(stack.back());
		stack.pop_back();
		for (const int child : m_cliques[missing.back()].children)
			if (!m_cliques[child].has_rest) {
				m_cliques[child].rest_is_passing = true;
				stack.push_back(child);
			}
	}
	for (auto c = missing.rbegin(); c != missing.rend(); ++c) {
		takeFactors(m_cliques[*c], factors);
		sumRest(m_cliques[*c]);
		for (const int child : m_cliques[*c].children)
			if (m_cliques[child].rest_is_passing) {
				m_cliques[child].rest = {};
				m_cliques[child].has_rest = m_cliques[child].rest_is_passing = false;
			}
	}
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
	const TFront front{clique.panel.data(), clique.rest.data(), clique.size(), p, m_kernels->width};
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

const std::vector<int>& CBayesTree::solve(const TSolveEffort& effort, std::vector<Vector6d>& d)
{
	m_solved.clear();
	// Fresh cliques, parents first; their orphans; then what waits, and down as far as something changes.
	for (auto c = m_fresh.rbegin(); c != m_fresh.rend(); ++c)
		solveClique(m_cliques[*c], d);
	m_fresh.clear();
	for (const int c : m_adopted)
		reach(c, std::numeric_limits<float>::infinity());
	m_adopted.clear();
	solveReached(effort, d);
	return m_solved;
}

/** The clique's solution is to be looked at, since one that it depends on has changed by so many tolerances.
 */
void CBayesTree::reach(int c, float change)
{
	TClique& clique = m_cliques[c];
	if (clique.reached == 0) m_reached.push_back(c);
	clique.reached += change;
}

/** What small changes reach waits for later calls once enough has been solved. */
void CBayesTree::solveReached(const TSolveEffort& effort, std::vector<Vector6d>& d)
{
	const size_t enough = m_solved.size() + std::max(size_t(effort.nodes), m_reached.size());
	std::vector<int> wait;
	for (size_t k = 0; k < m_reached.size(); k++) {
		TClique& clique = m_cliques[m_reached[k]];
		if (clique.reached == 0) continue;	// taken out since
		if (clique.reached < effort.urgent && m_solved.size() >= enough) {
			wait.push_back(m_reached[k]);
			continue;
		}
		clique.reached = 0;
		const float change = changeOf(clique, effort.tolerance, d);
		if (change <= 1) continue;
		take(clique, d);
		for (const int child : clique.children)
			reach(child, change);
	}
	m_reached.swap(wait);
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
		m_solved.push_back(node);
	}
}

void CBayesTree::solveClique(const TClique& clique, std::vector<Vector6d>& d)
{
	backSubstitute(clique, d);
	take(clique, d);
}

/** By how many tolerances the clique's solution changes most. When by none, the old solution is kept, so that
 * small changes cannot add up unseen. */
float CBayesTree::changeOf(const TClique& clique, const Vector6d& tolerance, const std::vector<Vector6d>& d)
{
	backSubstitute(clique, d);
	double change = 0;
	for (size_t k = 0; k < clique.pivots.size(); k++) {
		const Vector6d step = Eigen::Map<const Vector6d>(&m_x[6 * k]) - d[clique.pivots[k]];
		change = std::max(change, (step.array().abs() / tolerance.array()).maxCoeff());
	}
	return float(change);
}
}  // namespace posidonia
