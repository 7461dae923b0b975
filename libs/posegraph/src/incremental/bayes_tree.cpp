#include <posidonia/base/error.h>
#include <posidonia/posegraph/bayes_tree.h>

#include <algorithm>

#include "elimination/front_storage.h"
#include "elimination/simd/front_kernels.h"

namespace posidonia
{
CBayesTree::CBayesTree() : m_kernels(&frontKernels()) {}

void CBayesTree::clear()
{
	const size_t version = m_version + 1;
	*this = CBayesTree();
	m_version = version;
}

void CBayesTree::touch(int c)
{
	for (; c >= 0 && !m_touched_flag[c]; c = m_cliques[c].parent) {
		m_touched_flag[c] = 1;
		m_touched.push_back(c);
		m_touched_work += m_cliques[c].work;
		m_touched_nodes += int(m_cliques[c].pivots.size());
	}
}

int CBayesTree::cliqueOfFactor(int factor) const
{
	return factor < int(m_clique_of_factor.size()) ? m_clique_of_factor[factor] : -1;
}

/** Rests are larger than L together; they matter only where a parent is touched. Of cliques that have not
 * been touched for long only so many are kept that each stands for kStandsFor times as many pivots as its
 * separator has: finding it again costs about so many dense eliminations of that size. */
void CBayesTree::dropOldRests()
{
	constexpr size_t kHot = 200;  // updates
	constexpr int kStandsFor = 8;
	for (; !m_by_age.empty() && m_by_age.front().since + kHot < m_version; m_by_age.pop_front()) {
		TClique& clique = m_cliques[m_by_age.front().clique];
		if (clique.made == m_by_age.front().made && clique.parent >= 0) dropRestUnless(clique, kStandsFor);
	}
}

/** Of large fronts, which are cut into long chains, one dense elimination is risked at once. */
void CBayesTree::dropLargeRestsBelow(const TClique& clique)
{
	constexpr size_t kLarge = 1 << 17;	// doubles
	for (const int child : clique.children)
		if (m_cliques[child].rest.size() > kLarge) dropRestUnless(m_cliques[child], 1);
}

void CBayesTree::dropRestUnless(TClique& clique, int stands_for)
{
	clique.kept_below = int(clique.pivots.size());
	for (const int child : clique.children)
		if (!m_cliques[child].has_rest) clique.kept_below += m_cliques[child].kept_below;
	if (clique.kept_below >= stands_for * clique.left()) return;
	clique.rest = {};
	clique.has_rest = false;
}

CBayesTree::TTop CBayesTree::takeTop()
{
	TTop top;
	for (const int c : m_touched) {
		TClique& clique = m_cliques[c];
		top.nodes.insert(top.nodes.end(), clique.pivots.begin(), clique.pivots.end());
		top.factors.insert(top.factors.end(), clique.factors.begin(), clique.factors.end());
		for (const int child : clique.children)
			if (!m_touched_flag[child]) {
				top.orphans.push_back(child);
				m_cliques[child].parent = -1;
			}
	}
	for (const int c : m_touched) {
		m_whole_work -= m_cliques[c].work;
		m_cliques[c] = {};
		m_touched_flag[c] = 0;
		m_unused.push_back(c);
	}
	m_touched.clear();
	m_touched_work = 0;
	m_touched_nodes = 0;
	std::sort(top.nodes.begin(), top.nodes.end(), [&](int a, int b) { return m_rank[a] < m_rank[b]; });
	std::sort(top.factors.begin(), top.factors.end());
	std::sort(top.orphans.begin(), top.orphans.end(), [&](int a, int b) {
		return m_rank[m_cliques[a].pivots.front()] < m_rank[m_cliques[b].pivots.front()];
	});
	return top;
}

int CBayesTree::eliminate(
	const TTop& top, const std::vector<int>& order, const std::vector<double>& late, CFactorSource& factors)
{
	m_version++;
	const TEliminationForest forest = forestOf(top, order, late, factors);
	recoverRests(top.orphans, factors);
	m_fresh = newCliques(forest, order);
	for (const int factor : top.factors)
		placeFactor(factor, factors.nodesOf(factor));
	m_adopted = top.orphans;
	for (const int orphan : top.orphans)
		adoptOrphan(orphan);
	for (const int c : m_fresh) {
		const int failed = eliminateClique(m_cliques[c], factors);
		if (failed >= 0) return failed;
		dropLargeRestsBelow(m_cliques[c]);
		m_by_age.push_back({c, m_version, m_version});
	}
	dropOldRests();
	return -1;
}

double CBayesTree::workOf(const TTop& top, const std::vector<int>& order, const CFactorSource& factors)
{
	double work = 0;
	for (const auto& clique : forestOf(top, order, {}, factors).cliques)
		work += eliminationWork(clique.pivots, clique.left());
	return work;
}

/** Of positions in the order, which stand in for the top's nodes. */
TEliminationForest CBayesTree::forestOf(
	const TTop& top, const std::vector<int>& order, const std::vector<double>& late,
	const CFactorSource& factors)
{
	for (size_t k = 0; k < order.size(); k++) {
		const size_t node = size_t(order[k]);
		if (node >= m_clique_of.size()) {
			m_clique_of.resize(node + 1, -1);
			m_rank.resize(node + 1, -1);
			m_local.resize(node + 1, -1);
		}
		m_local[node] = int(k);
	}
	constexpr int kMaxPivots = 16;	// a touched pivot takes those of its clique with it
	return eliminationForest(int(order.size()), setsOf(top, factors), {late, kMaxPivots});
}

/** What is coupled by a factor, and what by a subtree; members as in m_local. */
TVariableSets CBayesTree::setsOf(const TTop& top, const CFactorSource& factors)
{
	TVariableSets sets;
	std::vector<int> members;
	const auto addSet = [&](const int* nodes, int count) {
		members.clear();
		for (int k = 0; k < count; k++)
			members.push_back(m_local[nodes[k]]);
		std::sort(members.begin(), members.end());
		sets.add(members.data(), members.data() + count);
	};
	for (const int factor : top.factors) {
		const TFactorNodes nodes = factors.nodesOf(factor);
		addSet(nodes.node, nodes.count);
	}
	for (const int orphan : top.orphans)
		addSet(m_cliques[orphan].separator.data(), m_cliques[orphan].left());
	return sets;
}

int CBayesTree::newSlot()
{
	if (m_unused.empty()) {
		m_cliques.emplace_back();
		m_touched_flag.push_back(0);
		return int(m_cliques.size()) - 1;
	}
	const int slot = m_unused.back();
	m_unused.pop_back();
	return slot;
}

/** The forest's cliques, empty, in its order: children first. */
std::vector<int> CBayesTree::newCliques(const TEliminationForest& forest, const std::vector<int>& order)
{
	std::vector<int> slots;
	for (size_t k = 0; k < forest.cliques.size(); k++)
		slots.push_back(newSlot());
	for (size_t k = 0; k < forest.cliques.size(); k++) {
		const auto& from = forest.cliques[k];
		TClique& clique = m_cliques[slots[k]];
		clique.parent = from.parent < 0 ? -1 : slots[from.parent];
		for (const int child : from.children)
			clique.children.push_back(slots[child]);
		for (int p = from.first; p < from.first + from.pivots; p++) {
			const int node = order[forest.order[p]];
			clique.pivots.push_back(node);
			m_clique_of[node] = slots[k];
			m_rank[node] = m_next_rank++;
		}
		for (const int p : from.separator)
			clique.separator.push_back(order[forest.order[p]]);
		clique.made = m_version;
		clique.work = eliminationWork(from.pivots, from.left());
		m_whole_work += clique.work;
	}
	return slots;
}

/** To the clique of the node that is eliminated first. */
void CBayesTree::placeFactor(int factor, const TFactorNodes& nodes)
{
	if (factor >= int(m_clique_of_factor.size())) m_clique_of_factor.resize(size_t(factor) + 1, -1);
	const int* first = std::min_element(
		nodes.node, nodes.node + nodes.count, [&](int a, int b) { return m_rank[a] < m_rank[b]; });
	m_clique_of_factor[factor] = m_clique_of[*first];
	m_cliques[m_clique_of[*first]].factors.push_back(factor);
}

void CBayesTree::adoptOrphan(int orphan)
{
	const auto& separator = m_cliques[orphan].separator;
	const int first = *std::min_element(
		separator.begin(), separator.end(), [&](int a, int b) { return m_rank[a] < m_rank[b]; });
	m_cliques[orphan].parent = m_clique_of[first];
	m_cliques[m_clique_of[first]].children.push_back(orphan);
}

CCliqueFactor::TClique CBayesTree::clique(int c) const
{
	const TClique& clique = m_cliques[c];
	return {clique.parent,		  clique.size(),	   int(clique.pivots.size()),
			clique.pivots.data(), clique.panel.data(), clique.rows.data()};
}

std::vector<int> CBayesTree::parentsFirst() const
{
	std::vector<int> out;
	for (int c = 0; c < int(m_cliques.size()); c++)
		if (m_cliques[c].parent < 0 && !m_cliques[c].pivots.empty()) out.push_back(c);
	for (size_t k = 0; k < out.size(); k++)
		out.insert(out.end(), m_cliques[out[k]].children.begin(), m_cliques[out[k]].children.end());
	return out;
}
}  // namespace posidonia
