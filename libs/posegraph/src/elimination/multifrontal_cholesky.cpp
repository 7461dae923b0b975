#include <posidonia/posegraph/elimination_order.h>
#include <posidonia/posegraph/multifrontal_cholesky.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "elimination/front_storage.h"
#include "elimination/simd/front_kernels.h"

namespace posidonia
{
const char* simdName()
{
	return frontKernels().name;
}

CMultifrontalCholesky::CMultifrontalCholesky(int threads) : m_threads(threads), m_kernels(frontKernels()) {}

const std::vector<int>& CMultifrontalCholesky::order(
	int block_count, const std::vector<CBlockMatrix::TPosition>& below)
{
	const std::vector<int> amd = minimumDegreeOrder(block_count, below);
	std::vector<int> position(block_count);
	for (int k = 0; k < block_count; k++)
		position[amd[k]] = k;
	TVariableSets pairs;
	for (const auto& [a, b] : below) {
		const int ends[2] = {std::min(position[a], position[b]), std::max(position[a], position[b])};
		pairs.add(ends, ends + 2);
	}
	m_forest = eliminationForest(block_count, pairs);
	for (int& variable : m_forest.order)
		variable = amd[variable];
	return m_forest.order;
}

void CMultifrontalCholesky::analyze(const CBlockMatrix& H)
{
	m_block_row.clear();
	for (int column = 0; column < H.blockCount(); column++) {
		const auto& clique = m_forest.cliques[m_forest.clique_of[column]];
		// Both lists ascend.
		auto at = clique.separator.begin();
		for (const int row : H.rowsOfColumn(column)) {
			const bool pivot = row < clique.first + clique.pivots;
			if (!pivot) at = std::lower_bound(at, clique.separator.end(), row);
			m_block_row.push_back(
				pivot ? row - clique.first : clique.pivots + int(at - clique.separator.begin()));
		}
	}
	placePanels();
	mapSeparators();
	chooseTasks();
	placeRests();
	m_x.resize(H.dimension());
	m_analyses++;
}

void CMultifrontalCholesky::placePanels()
{
	size_t size = 0;
	int largest = 0;
	m_panel_at.clear();
	for (const auto& clique : m_forest.cliques) {
		m_panel_at.push_back(size);
		size += frontSize(clique.size(), clique.pivots, m_kernels.width);
		largest = std::max(largest, clique.size());
	}
	m_panels.resize(size);
	m_local.resize(6 * largest);
}

void CMultifrontalCholesky::mapSeparators()
{
	m_rows.clear();
	m_rows_at.clear();
	for (const auto& clique : m_forest.cliques) {
		m_rows_at.push_back(m_rows.size());
		if (clique.parent >= 0) appendRowsInParent(clique, m_forest.cliques[clique.parent], m_rows);
	}
}

/** Subtrees that are worth a thread, the same whatever the number of threads; m_top is what remains. */
void CMultifrontalCholesky::chooseTasks()
{
	constexpr double kShare = 0.15;	 // of the whole work
	const auto work = subtreeWork(m_forest);
	double total = 0;
	for (size_t c = 0; c < work.size(); c++)
		if (m_forest.cliques[c].parent < 0) total += work[c];
	const auto first = firstOfSubtree(m_forest);
	m_subtrees.clear();
	m_top.clear();
	for (int c = 0; c < int(work.size()); c++) {
		const int parent = m_forest.cliques[c].parent;
		const bool small = work[c] <= kShare * total;
		if (small && (parent < 0 || work[parent] > kShare * total)) m_subtrees.push_back({first[c], c + 1});
		if (!small) m_top.push_back({c, c + 1});
	}
	m_failures.assign(m_subtrees.size(), -1);
}

/** Where each clique leaves its rest until the parent has summed it: found once, since the order of events is
 * known. Tasks share nothing, as they may run at the same time. */
void CMultifrontalCholesky::placeRests()
{
	m_rest_at.assign(m_forest.cliques.size(), 0);
	size_t base = 0;
	const auto place = [&](const std::vector<TTask>& tasks) {
		CSpace space;
		for (const TTask& task : tasks)
			for (int c = task.first; c < task.last; c++) {
				const auto& clique = m_forest.cliques[c];
				const int blocks = clique.left();
				m_rest_at[c] = base + space.take(c, frontSize(blocks, blocks, m_kernels.width));
				for (const int child : clique.children)
					space.release(child);
			}
		base += space.size();
	};
	for (const TTask& task : m_subtrees)
		place({task});
	place(m_top);
	m_rests.resize(base);
}

bool CMultifrontalCholesky::factorize(const CBlockMatrix& H, const Eigen::VectorXd& b)
{
	m_factorizations++;
	std::fill(m_failures.begin(), m_failures.end(), -1);
	std::atomic<size_t> next{0};
	const auto work = [&] {
		for (size_t k = next++; k < m_subtrees.size(); k = next++)
			eliminateRange(m_subtrees[k], H, b, m_failures[k]);
	};
	std::vector<std::thread> others;
	for (int t = 1; t < m_threads && t < int(m_subtrees.size()); t++)
		others.emplace_back(work);
	work();
	for (auto& thread : others)
		thread.join();
	for (const int f : m_failures)
		if (f >= 0) return m_failed = f, false;
	for (const TTask& task : m_top)
		if (!eliminateRange(task, H, b, m_failed)) return false;
	return true;
}

bool CMultifrontalCholesky::eliminateRange(
	const TTask& task, const CBlockMatrix& H, const Eigen::VectorXd& b, int& failed)
{
	for (int c = task.first; c < task.last; c++) {
		const int pivot = eliminate(c, H, b);
		if (pivot < 0) continue;
		failed = m_forest.cliques[c].first + pivot;
		return false;
	}
	return true;
}

/** The pivot that fails, -1 when all is well. */
int CMultifrontalCholesky::eliminate(int c, const CBlockMatrix& H, const Eigen::VectorXd& b)
{
	const auto& clique = m_forest.cliques[c];
	assemble(c, H, b);
	double* L = m_panels.data() + m_panel_at[c];
	const int failed = m_kernels.factorize(L, clique.size(), clique.pivots);
	if (failed >= 0) return failed;
	m_kernels.update(L, clique.size(), clique.pivots, rest(c));
	for (const int child : clique.children)
		m_kernels.addToRest(
			rest(child), m_forest.cliques[child].left(), rowsInParent(child), rest(c), clique.size(),
			clique.pivots);
	return failed;
}

void CMultifrontalCholesky::assemble(int c, const CBlockMatrix& H, const Eigen::VectorXd& b)
{
	const auto& clique = m_forest.cliques[c];
	const int m = clique.size(), p = clique.pivots, width = m_kernels.width;
	double* L = m_panels.data() + m_panel_at[c];
	std::fill_n(L, frontSize(m, p, width), 0.0);
	for (int J = 0; J < p; J++) {
		const int column = clique.first + J, ld = paddedRows(m, J, width);
		double* to = L + blockColumnOffset(m, J, width);
		addColumn(H, column, &m_block_row[H.firstBlock(column)], J, to, ld);
		for (int k = 0; k < 6; k++)
			to[k * ld + 6 * (m - J)] = b[6 * column + k];
	}
	for (const int child : clique.children)
		m_kernels.addToPanel(rest(child), m_forest.cliques[child].left(), rowsInParent(child), L, m, p);
}

const Eigen::VectorXd& CMultifrontalCholesky::solve()
{
	for (int c = int(m_forest.cliques.size()) - 1; c >= 0; c--) {
		const auto& clique = m_forest.cliques[c];
		double* x = m_local.data() + 6 * clique.pivots;
		for (const int j : clique.separator) {
			std::copy_n(m_x.data() + 6 * j, 6, x);
			x += 6;
		}
		m_kernels.backSubstitute(panel(c), clique.size(), clique.pivots, m_local.data());
		std::copy_n(m_local.data(), 6 * clique.pivots, m_x.data() + 6 * clique.first);
	}
	return m_x;
}
}  // namespace posidonia
