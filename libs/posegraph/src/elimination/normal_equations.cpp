#include <posidonia/posegraph/normal_equations.h>

#include <algorithm>

namespace posidonia
{
void CNormalEquations::followStructure(const CPoseGraph& graph, CMultifrontalCholesky& cholesky)
{
	if (!m_structure.follow(graph) && m_ready) return;
	m_ready = false;
	m_structure.requireHeld(graph);
	orderAndAnalyze(int(m_structure.freeNodes().size()), coupledFreePairs(graph.nodeCount()), cholesky);
	nameColumns(graph.nodeCount());
	findSlots();
	m_ready = true;
}

/** Pairs (a, b), a < b, of free nodes that share a factor, by their number among the free ones. */
std::vector<CBlockMatrix::TPosition> CNormalEquations::coupledFreePairs(size_t node_count) const
{
	std::vector<int> index(node_count, -1);
	int next = 0;
	for (const int node : m_structure.freeNodes())
		index[node] = next++;
	std::vector<CBlockMatrix::TPosition> pairs;
	pairs.reserve(m_structure.pairs().size());
	for (const auto& [a, b] : m_structure.pairs())
		if (index[a] >= 0 && index[b] >= 0) pairs.push_back({index[a], index[b]});
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

void CNormalEquations::nameColumns(size_t node_count)
{
	m_node_of_column.resize(m_order.size());
	m_column_of_node.assign(node_count, -1);
	for (size_t column = 0; column < m_order.size(); column++) {
		m_node_of_column[column] = m_structure.freeNodes()[m_order[column]];
		m_column_of_node[m_node_of_column[column]] = int(column);
	}
}

void CNormalEquations::findSlots()
{
	m_edge_slots.clear();
	m_prior_slots.clear();
	for (const TFactorNodes& nodes : m_structure.edges())
		m_edge_slots.push_back(slotsOf(nodes));
	for (const TFactorNodes& nodes : m_structure.priors())
		m_prior_slots.push_back(slotsOf(nodes));
}

CNormalEquations::TFactorSlots CNormalEquations::slotsOf(const TFactorNodes& nodes) const
{
	TFactorSlots slots{nodes.count, {-1, -1, -1}, {}};
	for (int a = 0; a < nodes.count; a++) {
		const int column = slots.column[a] = m_column_of_node[nodes.node[a]];
		if (column < 0) continue;
		slots.slot[TFactorNormal::lower(a, a)] = m_H.diagonalSlot(column);
		for (int b = 0; b < a; b++)
			if (slots.column[b] >= 0)
				slots.slot[TFactorNormal::lower(a, b)] =
					m_H.slot(std::max(column, slots.column[b]), std::min(column, slots.column[b]));
	}
	return slots;
}

TChi2 CNormalEquations::linearize(const CPoseGraph& graph)
{
	m_H.setZero();
	m_b.setZero();
	TChi2 sum;
	for (size_t k = 0; k < m_edge_slots.size(); k++) {
		const TPoseEdge& edge = graph.edges()[k];
		add(m_edge_slots[k], linearizeEdge(edge, graph.states()), edge.loss, sum);
	}
	for (size_t k = 0; k < m_prior_slots.size(); k++) {
		const TPosePrior& prior = graph.priors()[k];
		add(m_prior_slots[k], linearizePrior(prior, graph.states()), prior.loss, sum);
	}
	return sum;
}

void CNormalEquations::add(
	const TFactorSlots& slots, const TFactorNormal& normal, const TRobustLoss& loss, TChi2& sum)
{
	const double weight = robustWeight(loss, normal.s);
	for (int a = 0, k = 0; a < slots.count; a++) {
		const int column = slots.column[a];
		for (int b = 0; b < a; b++, k++) {
			if (column < 0 || slots.column[b] < 0) continue;
			auto block = m_H.block(slots.slot[k]);
			if (column > slots.column[b])
				block += weight * normal.H[k];
			else
				block += weight * normal.H[k].transpose();
		}
		if (column >= 0) {
			m_H.block(slots.slot[k]) += weight * normal.H[k];
			m_b.segment<6>(6 * column) -= weight * normal.g[a];
		}
		k++;
	}
	sum.plain += normal.s;
	sum.robust += robustCost(loss, normal.s);
}
}  // namespace posidonia
