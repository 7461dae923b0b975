#include <posidonia/base/error.h>
#include <posidonia/posegraph/normal_equations.h>

#include <algorithm>
#include <numeric>

namespace posidonia
{
namespace
{
/** Sets joined by edges, with path halving. */
class CDisjointSets
{
   public:
	explicit CDisjointSets(size_t n) : m_parent(n) { std::iota(m_parent.begin(), m_parent.end(), 0); }
	int find(int i)
	{
		while (m_parent[i] != i)
			i = m_parent[i] = m_parent[m_parent[i]];
		return i;
	}
	void join(int a, int b) { m_parent[find(a)] = find(b); }

   private:
	std::vector<int> m_parent;
};
}  // namespace

void CNormalEquations::followStructure(const CPoseGraph& graph, CMultifrontalCholesky& cholesky)
{
	if (sameStructure(graph)) return;
	requireConnected(graph);
	rememberStructure(graph);

	std::vector<int> free_index(graph.nodeCount(), -1);
	m_node_of_column.clear();
	for (int node = 0; node < int(graph.nodeCount()); node++) {
		if (m_fixed[node]) continue;
		free_index[node] = int(m_node_of_column.size());
		m_node_of_column.push_back(node);
	}
	const std::vector<int> free_nodes = m_node_of_column;
	const auto pairs = coupledPairs(free_index);
	orderAndAnalyze(int(free_nodes.size()), pairs, cholesky);

	m_column_of_node.assign(graph.nodeCount(), -1);
	for (size_t column = 0; column < m_order.size(); column++) {
		m_node_of_column[column] = free_nodes[m_order[column]];
		m_column_of_node[m_node_of_column[column]] = int(column);
	}
	findSlots();
}

bool CNormalEquations::sameStructure(const CPoseGraph& graph) const
{
	if (graph.nodeCount() != m_fixed.size() || graph.edgeCount() != m_ends.size()) return false;
	for (size_t node = 0; node < m_fixed.size(); node++)
		if (graph.isFixed(int(node)) != bool(m_fixed[node])) return false;
	for (size_t k = 0; k < m_ends.size(); k++)
		if (m_ends[k] != std::array<int, 2>{graph.edges()[k].from, graph.edges()[k].to}) return false;
	return true;
}

void CNormalEquations::rememberStructure(const CPoseGraph& graph)
{
	m_fixed.resize(graph.nodeCount());
	for (size_t node = 0; node < m_fixed.size(); node++)
		m_fixed[node] = graph.isFixed(int(node));
	m_ends.clear();
	for (const TPoseEdge& edge : graph.edges())
		m_ends.push_back({edge.from, edge.to});
}

void CNormalEquations::requireConnected(const CPoseGraph& graph) const
{
	CDisjointSets sets(graph.nodeCount());
	for (const TPoseEdge& edge : graph.edges())
		sets.join(edge.from, edge.to);
	std::vector<char> held(graph.nodeCount(), 0);
	for (int node = 0; node < int(graph.nodeCount()); node++)
		if (graph.isFixed(node)) held[sets.find(node)] = 1;
	for (int node = 0; node < int(graph.nodeCount()); node++)
		if (!held[sets.find(node)])
			throw CError(
				"node " + std::to_string(node), "no chain of edges joins it to a fixed node",
				"fix a node of its component or add the missing edge");
}

/** Pairs (a, b), a < b, of free nodes that share an edge, sorted, each once. */
std::vector<CBlockMatrix::TPosition> CNormalEquations::coupledPairs(const std::vector<int>& index) const
{
	std::vector<CBlockMatrix::TPosition> pairs;
	pairs.reserve(m_ends.size());
	for (const auto& [from, to] : m_ends)
		if (index[from] >= 0 && index[to] >= 0)
			pairs.push_back({std::min(index[from], index[to]), std::max(index[from], index[to])});
	std::sort(pairs.begin(), pairs.end());
	pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
	return pairs;
}

void CNormalEquations::orderAndAnalyze(
	int free_count, const std::vector<CBlockMatrix::TPosition>& pairs, CMultifrontalCholesky& cholesky)
{
	// A second edge between joined nodes, or another numbering of the same pattern, needs no new analysis.
	if (free_count == m_ordered_count && pairs == m_ordered_pairs) return;
	m_order = cholesky.order(free_count, pairs);
	std::vector<int> column(free_count);
	for (int k = 0; k < free_count; k++)
		column[m_order[k]] = k;
	std::vector<CBlockMatrix::TPosition> below;
	below.reserve(pairs.size());
	for (const auto& [a, b] : pairs)
		below.push_back({std::min(column[a], column[b]), std::max(column[a], column[b])});
	std::sort(below.begin(), below.end());
	m_H.setPattern(free_count, below);
	m_b.resize(m_H.dimension());
	if (free_count > 0) cholesky.analyze(m_H);
	m_ordered_count = free_count;
	m_ordered_pairs = pairs;
}

void CNormalEquations::findSlots()
{
	m_slots.clear();
	for (const auto& [from, to] : m_ends) {
		TEdgeSlots slots{m_column_of_node[from], m_column_of_node[to], {}, {}, {}};
		if (slots.from_column >= 0) slots.from = m_H.diagonalSlot(slots.from_column);
		if (slots.to_column >= 0) slots.to = m_H.diagonalSlot(slots.to_column);
		if (slots.from_column >= 0 && slots.to_column >= 0)
			slots.cross = m_H.slot(
				std::max(slots.from_column, slots.to_column), std::min(slots.from_column, slots.to_column));
		m_slots.push_back(slots);
	}
}

TChi2 CNormalEquations::linearize(const CPoseGraph& graph)
{
	m_H.setZero();
	m_b.setZero();
	TChi2 sum;
	for (size_t k = 0; k < m_slots.size(); k++) {
		const TPoseEdge& edge = graph.edges()[k];
		const TEdgeNormal normal = edgeNormal(edge, graph.poses()[edge.from], graph.poses()[edge.to]);
		addEdge(m_slots[k], normal, robustWeight(edge.loss, normal.s));
		sum.plain += normal.s;
		sum.robust += robustCost(edge.loss, normal.s);
	}
	return sum;
}

void CNormalEquations::addEdge(const TEdgeSlots& slots, const TEdgeNormal& normal, double weight)
{
	const int from = slots.from_column, to = slots.to_column;
	if (from >= 0) {
		m_H.block(slots.from) += weight * normal.H_from_from;
		m_b.segment<6>(6 * from) -= weight * normal.g_from;
	}
	if (to >= 0) {
		m_H.block(slots.to) += weight * normal.H_to_to;
		m_b.segment<6>(6 * to) -= weight * normal.g_to;
	}
	if (from < 0 || to < 0) return;
	if (from > to)
		m_H.block(slots.cross) += weight * normal.H_from_to;
	else
		m_H.block(slots.cross) += weight * normal.H_from_to.transpose();
}
}  // namespace posidonia
