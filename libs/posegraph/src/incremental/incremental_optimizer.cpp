#include <posidonia/posegraph/incremental_optimizer.h>

#include <algorithm>

namespace posidonia
{
/** The graph's factors as the tree asks for them. */
class CIncrementalOptimizer::CWeightedFactors : public CFactorSource
{
   public:
	CWeightedFactors(CIncrementalOptimizer& optimizer, const CPoseGraph& graph)
		: m_optimizer(optimizer), m_graph(graph)
	{
	}
	TFactorNodes nodesOf(int factor) const override { return m_optimizer.m_factor_nodes[factor]; }
	void weighAnew(int factor) override
	{
		m_optimizer.m_weights[factor] = m_optimizer.weightOf(m_graph, factor);
	}
	TFactorNormal normalOf(int factor) const override { return m_optimizer.normalOf(m_graph, factor); }

   private:
	CIncrementalOptimizer& m_optimizer;
	const CPoseGraph& m_graph;
};

CIncrementalOptimizer::CIncrementalOptimizer(
	const TIncrementalOptions& options, const TOptimizerOptions& batch)
	: m_options(options), m_batch(batch)
{
}

TIncrementalResult CIncrementalOptimizer::update(
	CPoseGraph& graph, const std::vector<int>& changed_edges, const std::vector<int>& changed_priors)
{
	TIncrementalResult result;
	touchChanged(changed_edges, changed_priors);
	followNodes(graph);
	followFactors(graph, result);
	relinearizeMoved(result);
	touchReweighted();
	m_outlook = outlook();
	touchAhead();
	constexpr int kRounds = 8;
	for (int round = 1; eliminate(graph, result) < 0; round++) {
		solve(graph, result);
		if (round == kRounds || !touchUnsettledNewest(result)) return result;
	}
	// The linear model of the cliques may fail where the batch optimiser's damping does not.
	takeAllOut(graph);
	refine(graph);
	result.rebuilt = true;
	return result;
}

void CIncrementalOptimizer::followNodes(const CPoseGraph& graph)
{
	for (int node = int(m_d.size()); node < int(graph.nodeCount()); node++) {
		m_linearization.poses.push_back(graph.states().poses[node]);
		m_linearization.values.push_back(graph.states().values[node]);
		m_kinds.push_back(graph.nodeKind(node));
		m_free.push_back(!graph.isFixed(node));
		m_d.push_back(Vector6d::Zero());
		m_is_moved.push_back(0);
		m_is_seen.push_back(0);
		m_factors_of.emplace_back();
		if (m_free.back()) m_new_nodes.push_back(node);
	}
}

void CIncrementalOptimizer::followFactors(const CPoseGraph& graph, TIncrementalResult& result)
{
	for (size_t k = m_factor_of_edge.size(); k < graph.edgeCount(); k++) {
		m_factor_of_edge.push_back(int(m_factors.size()));
		addFactor({false, int(k)}, nodesOf(graph.edges()[k]));
	}
	for (size_t k = m_factor_of_prior.size(); k < graph.priorCount(); k++) {
		m_factor_of_prior.push_back(int(m_factors.size()));
		addFactor({true, int(k)}, nodesOf(graph.priors()[k]));
	}
	result.new_nodes = int(m_new_nodes.size());
	result.new_factors = int(m_new_factors.size());
}

void CIncrementalOptimizer::addFactor(const TFactor& factor, const TFactorNodes& nodes)
{
	const int number = int(m_factors.size());
	TFactorNodes free;
	for (int a = 0; a < nodes.count; a++) {
		if (!m_free[nodes.node[a]]) continue;
		free.node[free.count++] = nodes.node[a];
		m_factors_of[nodes.node[a]].push_back(number);
		m_tree.touch(m_tree.cliqueOf(nodes.node[a]));
	}
	m_factors.push_back(factor);
	m_factor_nodes.push_back(free);
	m_weights.push_back(1);
	m_is_reweighted.push_back(0);
	if (free.count > 0) m_new_factors.push_back(number);
}

void CIncrementalOptimizer::touchChanged(const std::vector<int>& edges, const std::vector<int>& priors)
{
	for (const int k : edges)
		if (k < int(m_factor_of_edge.size())) m_tree.touch(m_tree.cliqueOfFactor(m_factor_of_edge[k]));
	for (const int k : priors)
		if (k < int(m_factor_of_prior.size())) m_tree.touch(m_tree.cliqueOfFactor(m_factor_of_prior[k]));
}

/** The node where H is not positive definite, else -1. */
int CIncrementalOptimizer::eliminate(const CPoseGraph& graph, TIncrementalResult& result)
{
	result.work += m_tree.touchedWork();
	CBayesTree::TTop top = m_tree.takeTop();
	top.nodes.insert(top.nodes.end(), m_new_nodes.begin(), m_new_nodes.end());
	top.factors.insert(top.factors.end(), m_new_factors.begin(), m_new_factors.end());
	m_new_nodes.clear();
	m_new_factors.clear();
	result.eliminated += int(top.nodes.size());
	CWeightedFactors factors(*this, graph);
	const std::vector<int> order = orderOf(top, factors);
	return m_tree.eliminate(top, order, nearness(order), factors);
}

void CIncrementalOptimizer::solve(CPoseGraph& graph, TIncrementalResult& result)
{
	Vector6d tolerance = Vector6d::Constant(m_options.solve_tolerance);
	tolerance.tail<3>() /= 10;	   // a turn moves what is far away
	constexpr double kUrgent = 5;  // tolerances
	const std::vector<int>& solved = m_tree.solve({tolerance, m_options.max_solved, kUrgent}, m_d);
	for (const int node : solved) {
		moveNode(graph, node);
		if (m_is_moved[node] || m_d[node].lpNorm<Eigen::Infinity>() <= m_options.relinearize_step) continue;
		m_is_moved[node] = 1;
		m_moved.push_back(node);
	}
	for (const int node : solved)
		findReweighted(graph, node);
	result.solved += int(solved.size());
	result.waiting_cliques = int(m_tree.waiting());
}

/** The graph gets the estimate of the node. */
void CIncrementalOptimizer::moveNode(CPoseGraph& graph, int node) const
{
	if (m_kinds[node] == ENodeKind::ErrorVariable)
		graph.setErrorVariable(node, m_linearization.values[node] + m_d[node]);
	else
		graph.setPose(node, orthonormalized(retract(m_linearization.poses[node], m_d[node])));
}

TOptimizerResult CIncrementalOptimizer::refine(CPoseGraph& graph)
{
	TIncrementalResult ignored;
	followNodes(graph);
	followFactors(graph, ignored);
	TOptimizerResult result = m_batch.optimize(graph);
	rebuild(graph);
	return result;
}

/** A whole elimination at the graph's present states. */
void CIncrementalOptimizer::rebuild(const CPoseGraph& graph)
{
	takeAllOut(graph);
	TIncrementalResult ignored;
	const int failed = eliminate(graph, ignored);
	if (failed >= 0) {
		takeAllOut(graph);
		throw CError(
			describeNode(graph, failed), "the information matrix is singular to working precision there",
			"look for edges of weight zero or very unequal information");
	}
	m_tree.solve({Vector6d::Constant(1), 0, 0}, m_d);
}

/** Everything waits for the next elimination, at the graph's present states; also after an error, so that the
 * caller may mend the graph and go on. */
void CIncrementalOptimizer::takeAllOut(const CPoseGraph& graph)
{
	m_tree.clear();
	m_linearization = graph.states();
	m_new_nodes.clear();
	m_new_factors.clear();
	m_moved.clear();
	m_reweighted.clear();
	std::fill(m_is_reweighted.begin(), m_is_reweighted.end(), 0);
	std::fill(m_is_moved.begin(), m_is_moved.end(), 0);
	for (int node = 0; node < int(m_d.size()); node++) {
		m_d[node].setZero();
		if (m_free[node]) m_new_nodes.push_back(node);
	}
	for (int factor = 0; factor < int(m_factors.size()); factor++)
		if (m_factor_nodes[factor].count > 0) m_new_factors.push_back(factor);
	m_outlook = outlook();
}

CMarginals CIncrementalOptimizer::marginals() const
{
	return CMarginals(m_linearization.poses, m_tree);
}
}  // namespace posidonia
