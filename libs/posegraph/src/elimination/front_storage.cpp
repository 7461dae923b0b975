#include "elimination/front_storage.h"

#include <algorithm>

namespace posidonia
{
size_t CSpace::take(int owner, size_t size)
{
	auto piece = m_free.begin();
	while (piece != m_free.end() && piece->second < size)
		++piece;
	if (piece == m_free.end()) {
		// At the end, which may be free already.
		const bool joins = !m_free.empty() && m_free.rbegin()->first + m_free.rbegin()->second == m_size;
		const size_t begin = joins ? m_free.rbegin()->first : m_size;
		if (joins) m_free.erase(begin);
		m_size = begin + size;
		m_taken[owner] = {begin, size};
		return begin;
	}
	const auto [begin, free] = *piece;
	m_free.erase(piece);
	if (free > size) m_free[begin + size] = free - size;
	m_taken[owner] = {begin, size};
	return begin;
}

void CSpace::release(int owner)
{
	const auto taken = m_taken.find(owner);
	if (taken == m_taken.end()) return;
	auto [begin, size] = taken->second;
	m_taken.erase(taken);
	if (size == 0) return;
	auto next = m_free.lower_bound(begin);
	if (next != m_free.end() && next->first == begin + size) {
		size += next->second;
		next = m_free.erase(next);
	}
	if (next != m_free.begin() && std::prev(next)->first + std::prev(next)->second == begin)
		std::prev(next)->second += size;
	else
		m_free[begin] = size;
}

void appendRowsInParent(
	const TEliminationForest::TClique& clique, const TEliminationForest::TClique& parent,
	std::vector<int>& rows)
{
	auto at = parent.separator.begin();
	for (const int j : clique.separator) {
		const bool pivot = j < parent.first + parent.pivots;
		if (!pivot) at = std::lower_bound(at, parent.separator.end(), j);
		rows.push_back(pivot ? j - parent.first : parent.pivots + int(at - parent.separator.begin()));
	}
	rows.push_back(parent.size());
}

double eliminationWork(int pivots, int separator)
{
	const double p = 6.0 * pivots, s = 6.0 * separator;
	return p * p * p / 6 + p * p * s / 2 + p * s * s / 2;
}

std::vector<double> subtreeWork(const TEliminationForest& forest)
{
	std::vector<double> work(forest.cliques.size(), 0);
	for (size_t c = 0; c < work.size(); c++) {
		const auto& clique = forest.cliques[c];
		work[c] += eliminationWork(clique.pivots, clique.left());
		if (clique.parent >= 0) work[clique.parent] += work[c];
	}
	return work;
}

std::vector<int> firstOfSubtree(const TEliminationForest& forest)
{
	std::vector<int> first(forest.cliques.size());
	for (int c = 0; c < int(first.size()); c++) {
		const auto& children = forest.cliques[c].children;
		first[c] = children.empty() ? c : first[children.front()];
	}
	return first;
}

void addColumn(const CBlockMatrix& H, int column, const int* rows, int J, double* to, int ld)
{
	const auto [offset, stride] = H.diagonalSlot(column);
	const double* from = H.values() + offset;
	const int blocks = stride / 6;
	for (int b = 0; b < blocks; b++)
		for (int k = 0; k < 6; k++)
			for (int i = 0; i < 6; i++)
				to[k * ld + 6 * (rows[b] - J) + i] = from[k * stride + 6 * b + i];
}
}  // namespace posidonia
