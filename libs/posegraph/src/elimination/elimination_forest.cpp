#include <posidonia/posegraph/elimination_forest.h>

#include <algorithm>
#include <cstdint>

#include "elimination/front_storage.h"

namespace posidonia
{
namespace
{
/** A clique while the forest is being made. */
struct TNode
{
	std::vector<int> pivots, structure;	 // structure: what the last pivot is coupled with, later than it
	std::vector<int> children;
	int parent{-1};
};

/** Seconds to eliminate a front, in arbitrary units: a call, its entries to clear and sum, its products. */
double frontTime(size_t pivots, size_t separator)
{
	constexpr double kCall = 4000, kEntry = 6;	// of one multiply-add; flat round these
	const double p = 6 * double(pivots), s = 6 * double(separator);
	const double entries =
		p * (p + 1) / 2 + p * s + s * s;  // the separator's: cleared here, summed in the parent
	return kCall + kEntry * entries + eliminationWork(int(pivots), int(separator));
}

/** Symbolic elimination: the forest of fundamental cliques. */
class CSymbolicElimination
{
   public:
	CSymbolicElimination(int n, const TVariableSets& sets) : m_mark(n, -1), m_children_of(n)
	{
		const auto first_sets = setsByFirst(n, sets);
		for (int j = 0; j < n; j++)
			eliminate(j, sets, first_sets);
	}
	std::vector<TNode> nodes;

   private:
	/** Indices of the sets whose first member is j, for each j. */
	static TVariableSets setsByFirst(int n, const TVariableSets& sets)
	{
		TVariableSets by;
		by.starts.assign(size_t(n) + 1, 0);
		for (size_t k = 0; k < sets.size(); k++)
			if (sets.starts[k] < sets.starts[k + 1]) by.starts[size_t(sets.members[sets.starts[k]]) + 1]++;
		for (int j = 0; j < n; j++)
			by.starts[j + 1] += by.starts[j];
		by.members.resize(by.starts[n]);
		std::vector<int> next(by.starts.begin(), by.starts.end() - 1);
		for (size_t k = 0; k < sets.size(); k++)
			if (sets.starts[k] < sets.starts[k + 1])
				by.members[next[sets.members[sets.starts[k]]]++] = int(k);
		return by;
	}

	void take(const int* first, const int* last, int j)
	{
		for (; first != last; ++first)
			if (*first != j && m_mark[*first] != j) {
				m_mark[*first] = j;
				m_structure.push_back(*first);
			}
	}

	/** Structure of column j: its sets and what its children leave behind. */
	void eliminate(int j, const TVariableSets& sets, const TVariableSets& first_sets)
	{
		m_structure.clear();
		for (int k = first_sets.starts[j]; k < first_sets.starts[j + 1]; k++) {
			const int set = first_sets.members[k];
			take(&sets.members[sets.starts[set]], sets.members.data() + sets.starts[set + 1], j);
		}
		int same = -1;
		for (const int c : m_children_of[j])
			take(nodes[c].structure.data(), nodes[c].structure.data() + nodes[c].structure.size(), j);
		for (const int c : m_children_of[j])
			if (nodes[c].structure.size() == m_structure.size() + 1) same = c;
		const int node = same >= 0 ? same : int(nodes.size());
		if (same < 0) nodes.emplace_back();
		nodes[node].pivots.push_back(j);
		nodes[node].structure = m_structure;
		for (const int c : m_children_of[j])
			if (c != node) {
				nodes[c].parent = node;
				nodes[node].children.push_back(c);
			}
		if (!m_structure.empty())
			m_children_of[*std::min_element(m_structure.begin(), m_structure.end())].push_back(node);
	}

	std::vector<int> m_mark, m_structure;
	std::vector<std::vector<int>> m_children_of;  // nodes whose structure begins with the column
};

double frontTime(const TNode& node)
{
	return frontTime(node.pivots.size(), node.structure.size());
}

/** Joins `child` with its parent. */
void absorb(std::vector<TNode>& nodes, int parent, int child)
{
	TNode &p = nodes[parent], &c = nodes[child];
	p.pivots.insert(p.pivots.begin(), c.pivots.begin(), c.pivots.end());
	for (const int g : c.children)
		nodes[g].parent = parent;
	p.children.insert(p.children.end(), c.children.begin(), c.children.end());
	c.pivots.clear();
}

/** Children join their parent, largest separators first, while that is expected to save time. */
void amalgamate(std::vector<TNode>& nodes, const std::vector<int>& postorder)
{
	for (const int parent : postorder) {
		TNode& p = nodes[parent];
		std::vector<int> candidates = p.children;
		std::stable_sort(candidates.begin(), candidates.end(), [&](int a, int b) {
			return nodes[a].structure.size() > nodes[b].structure.size();
		});
		for (const int c : candidates) {
			const size_t pivots = p.pivots.size() + nodes[c].pivots.size();
			if (frontTime(pivots, p.structure.size()) > frontTime(p) + frontTime(nodes[c])) continue;
			p.children.erase(std::find(p.children.begin(), p.children.end(), c));
			absorb(nodes, parent, c);
		}
	}
}

/** Children before parents, each subtree in one piece. */
std::vector<int> postorderOf(const std::vector<TNode>& nodes)
{
	std::vector<int> out, stack;
	for (int root = 0; root < int(nodes.size()); root++) {
		if (nodes[root].parent >= 0 || nodes[root].pivots.empty()) continue;
		stack.push_back(root);
		const size_t begin = out.size();
		while (!stack.empty()) {
			const int node = stack.back();
			stack.pop_back();
			out.push_back(node);
			stack.insert(stack.end(), nodes[node].children.begin(), nodes[node].children.end());
		}
		std::reverse(out.begin() + begin, out.end());
	}
	return out;
}

/** Cliques of the node's pivots, in a chain when they are many; separators still by the old positions. */
void appendCliques(TNode& node, const TForestWishes& wishes, TEliminationForest& forest)
{
	if (!wishes.late.empty())
		std::stable_sort(node.pivots.begin(), node.pivots.end(), [&](int a, int b) {
			return wishes.late[a] < wishes.late[b];
		});
	const int count = int(node.pivots.size());
	const int pieces = (count + wishes.max_pivots - 1) / wishes.max_pivots;
	for (int k = 0; k < pieces; k++) {
		const int first = int(int64_t(count) * k / pieces), last = int(int64_t(count) * (k + 1) / pieces);
		TEliminationForest::TClique clique{int(forest.order.size()), last - first, {}, -1, {}};
		clique.separator.assign(node.pivots.begin() + last, node.pivots.end());
		clique.separator.insert(clique.separator.end(), node.structure.begin(), node.structure.end());
		for (int p = first; p < last; p++) {
			forest.order.push_back(node.pivots[p]);
			forest.clique_of.push_back(int(forest.cliques.size()));
		}
		forest.cliques.push_back(std::move(clique));
	}
}

TEliminationForest numbered(int n, std::vector<TNode>& nodes, const TForestWishes& wishes)
{
	TEliminationForest forest;
	forest.order.reserve(n);
	forest.clique_of.reserve(n);
	for (const int node : postorderOf(nodes))
		appendCliques(nodes[node], wishes, forest);
	std::vector<int> position(n);
	for (int p = 0; p < n; p++)
		position[forest.order[p]] = p;
	for (int c = 0; c < int(forest.cliques.size()); c++) {
		auto& clique = forest.cliques[c];
		for (int& j : clique.separator)
			j = position[j];
		std::sort(clique.separator.begin(), clique.separator.end());
		if (clique.separator.empty()) continue;
		clique.parent = forest.clique_of[clique.separator.front()];
		forest.cliques[clique.parent].children.push_back(c);
	}
	return forest;
}
}  // namespace

TEliminationForest eliminationForest(int n, const TVariableSets& sets, const TForestWishes& wishes)
{
	CSymbolicElimination symbolic(n, sets);
	amalgamate(symbolic.nodes, postorderOf(symbolic.nodes));
	return numbered(n, symbolic.nodes, wishes);
}
}  // namespace posidonia
