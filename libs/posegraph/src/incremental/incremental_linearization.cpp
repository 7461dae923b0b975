// What CIncrementalOptimizer linearises and weighs anew, and when.
#include <posidonia/posegraph/incremental_optimizer.h>

#include <algorithm>

namespace posidonia
{
/** Those that moved most first, as far as the work allows; a clique on the way to the root serves many. */
void CIncrementalOptimizer::relinearizeMoved(TIncrementalResult& result)
{
	const auto size = [&](int node) { return m_d[node].lpNorm<Eigen::Infinity>(); };
	std::stable_sort(m_moved.begin(), m_moved.end(), [&](int a, int b) { return size(a) > size(b); });
	const double allowed = m_options.max_work * m_tree.wholeWork();
	std::vector<int> waiting;
	for (const int node : m_moved) {
		m_is_moved[node] = 0;
		if (size(node) <= m_options.relinearize_step) continue;
		if (m_tree.touchedWork() <= allowed) {
			relinearize(node);
			result.relinearized++;
		}
		else {
			m_is_moved[node] = 1;
			waiting.push_back(node);
		}
	}
	result.waiting = int(waiting.size());
	m_moved = waiting;
}

/** Factors are weighted anew where they are summed anew; those beyond the allowed work wait. */
void CIncrementalOptimizer::touchReweighted()
{
	const double allowed = m_options.max_work * m_tree.wholeWork();
	size_t kept = 0;
	for (const int factor : m_reweighted) {
		if (!m_is_reweighted[factor]) continue;
		if (m_tree.touchedWork() <= allowed) {
			m_tree.touch(m_tree.cliqueOfFactor(factor));
			m_is_reweighted[factor] = 0;
		}
		else
			m_reweighted[kept++] = factor;
	}
	m_reweighted.resize(kept);
}

/** The newest pose came as a guess, at which its factors were weighted and linearised: it, which is to be
 * exact, is settled at once. False when it is. */
bool CIncrementalOptimizer::touchUnsettledNewest(TIncrementalResult& result)
{
	const int newest = m_outlook.newest;
	if (newest < 0 || !m_free[newest]) return false;
	bool unsettled = m_d[newest].lpNorm<Eigen::Infinity>() > m_options.relinearize_step;
	if (unsettled) {
		relinearize(newest);
		result.relinearized++;
	}
	for (const int factor : m_factors_of[newest])
		if (m_is_reweighted[factor]) {
			m_is_reweighted[factor] = 0;
			m_tree.touch(m_tree.cliqueOfFactor(factor));
			unsettled = true;
		}
	return unsettled;
}

void CIncrementalOptimizer::relinearize(int node)
{
	retractNode(m_kinds[node], m_d[node], node, m_linearization);
	m_d[node].setZero();
	m_tree.touch(m_tree.cliqueOf(node));
	for (const int factor : m_factors_of[node])
		m_tree.touch(m_tree.cliqueOfFactor(factor));
}

const TRobustLoss& CIncrementalOptimizer::lossOf(const CPoseGraph& graph, int factor) const
{
	const auto [prior, index] = m_factors[factor];
	return prior ? graph.priors()[index].loss : graph.edges()[index].loss;
}

/** The factor's weight at the graph's states, the estimate. */
double CIncrementalOptimizer::weightOf(const CPoseGraph& graph, int factor) const
{
	const TRobustLoss& loss = lossOf(graph, factor);
	if (loss.kind == ERobustLoss::None) return loss.weight;
	const auto [prior, index] = m_factors[factor];
	return robustWeight(
		loss, prior ? priorMahalanobis2(graph.priors()[index], graph.states())
					: edgeMahalanobis2(graph.edges()[index], graph.states()));
}

TFactorNormal CIncrementalOptimizer::normalOf(const CPoseGraph& graph, int factor) const
{
	const auto [prior, index] = m_factors[factor];
	TFactorNormal normal = prior ? linearizePrior(graph.priors()[index], m_linearization)
								 : linearizeEdge(graph.edges()[index], m_linearization);
	const double weight = m_weights[factor];
	int kept = 0;
	int from[3] = {};
	for (int a = 0; a < normal.count; a++)
		if (m_free[normal.node[a]]) from[kept++] = a;
	if (kept == normal.count && weight == 1) return normal;
	for (int a = 0; a < kept; a++) {
		normal.node[a] = normal.node[from[a]];
		normal.g[a] = weight * normal.g[from[a]];
		for (int b = 0; b <= a; b++)
			normal.H[TFactorNormal::lower(a, b)] = weight * normal.H[TFactorNormal::lower(from[a], from[b])];
	}
	normal.count = kept;
	return normal;
}

/** Of the robust factors of a node that has moved, those whose weight has changed. */
void CIncrementalOptimizer::findReweighted(const CPoseGraph& graph, int node)
{
	for (const int factor : m_factors_of[node]) {
		if (m_is_reweighted[factor] || lossOf(graph, factor).kind == ERobustLoss::None) continue;
		if (std::abs(weightOf(graph, factor) - m_weights[factor]) <= m_options.reweigh_step) continue;
		m_is_reweighted[factor] = 1;
		m_reweighted.push_back(factor);
	}
}
}  // namespace posidonia
