#include <posidonia/posegraph/elimination_order.h>
#include <posidonia/posegraph/incremental_optimizer.h>

#include <algorithm>
#include <numeric>

namespace posidonia
{
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
	if (eliminate(graph, result) >= 0) {
		// The linear model of the cliques may fail where the batch optimiser's damping does not.
		takeAllOut(graph);
		refine(graph);
		result.rebuilt = true;
		return result;
	}
	solve(graph, result);
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
	if (free.count > 0) m_new_factors.push_back(number);
}

void CIncrementalOptimizer::touchChanged(const std::vector<int>& edges, const std::vector<int>& priors)
{
	for (const int k : edges)
		if (k < int(m_factor_of_edge.size())) m_tree.touch(m_tree.cliqueOfFactor(m_factor_of_edge[k]));
	for (const int k : priors)
		if (k < int(m_factor_of_prior.size())) m_tree.touch(m_tree.cliqueOfFactor(m_factor_of_prior[k]));
}

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

void CIncrementalOptimizer::relinearize(int node)
{
	retractNode(m_kinds[node], m_d[node], node, m_linearization);
	m_d[node].setZero();
	m_tree.touch(m_tree.cliqueOf(node));
	for (const int factor : m_factors_of[node])
		m_tree.touch(m_tree.cliqueOfFactor(factor));
}

/** The node where H is not positive definite, else -1. */
int CIncrementalOptimizer::eliminate(const CPoseGraph& graph, TIncrementalResult& result)
{
	result.work = m_tree.touchedWork();
	CBayesTree::TTop top = m_tree.takeTop();
	top.nodes.insert(top.nodes.end(), m_new_nodes.begin(), m_new_nodes.end());
	top.factors.insert(top.factors.end(), m_new_factors.begin(), m_new_factors.end());
	m_new_nodes.clear();
	m_new_factors.clear();
	result.eliminated = int(top.nodes.size());
	const std::vector<int> order = orderOf(top);
	return m_tree.eliminate(
		top, order, nearNewest(order), [&](int factor) { return m_factor_nodes[factor]; },
		[&](int factor) { return normalOf(graph, factor); });
}

/** Minimum degree from ring to ring, the outermost first. */
std::vector<int> CIncrementalOptimizer::orderOf(const CBayesTree::TTop& top)
{
	const int n = int(top.nodes.size());
	m_local.resize(m_d.size());
	for (int k = 0; k < n; k++)
		m_local[top.nodes[k]] = k;
	m_pairs.clear();
	const auto couple = [&](const int* nodes, int count) {
		for (int a = 0; a < count; a++)
			for (int b = 0; b < a; b++)
				m_pairs.push_back({m_local[nodes[b]], m_local[nodes[a]]});
	};
	for (const int factor : top.factors)
		couple(m_factor_nodes[factor].node, m_factor_nodes[factor].count);
	for (const int orphan : top.orphans)
		couple(m_tree.separatorOf(orphan).data(), int(m_tree.separatorOf(orphan).size()));
	std::vector<int> order = constrainedMinimumDegreeOrder(n, m_pairs, ringsOf(top.nodes));
	for (int& k : order)
		k = top.nodes[k];
	return order;
}

/** Rings round the newest pose, the innermost with the highest number, each kRingGrowth times as large as the
 * one inside. The next nodes are joined on in the innermost, seldom further out: so the outer ones, whose
 * fronts are larger, are seldom eliminated anew. The newest node itself comes after all rings, as do error
 * variables, which are joined with everything. */
std::vector<int> CIncrementalOptimizer::ringsOf(const std::vector<int>& nodes) const
{
	constexpr double kRingGrowth = 4;
	const int n = int(nodes.size());
	const std::vector<double> late = nearNewest(nodes);
	std::vector<int> by_nearness(n);
	std::iota(by_nearness.begin(), by_nearness.end(), 0);
	std::sort(by_nearness.begin(), by_nearness.end(), [&](int a, int b) {
		return late[a] != late[b] ? late[a] > late[b] : nodes[a] > nodes[b];
	});
	int rings = 1;
	for (double size = m_options.inner_ring; size < n; size *= kRingGrowth)
		rings++;
	std::vector<int> ring_of(n, 0);
	if (n <= rings) return ring_of;	 // CAMD wants groups below n
	double size = m_options.inner_ring;
	for (int k = 0, ring = rings - 1; k < n; k++) {
		if (k >= size) ring--, size *= kRingGrowth;
		ring_of[by_nearness[k]] = ring;
	}
	for (int k = 0; k < n; k++)
		if (m_kinds[nodes[k]] == ENodeKind::ErrorVariable || nodes[k] == int(m_d.size()) - 1)
			ring_of[k] = rings;
	return ring_of;
}

/** Where the next nodes are likely to be joined on: the nearer to the newest pose, the sooner; error
 * variables at once. */
std::vector<double> CIncrementalOptimizer::nearNewest(const std::vector<int>& order) const
{
	if (order.empty()) return {};
	int newest = int(m_d.size()) - 1;
	while (newest > 0 && m_kinds[newest] != ENodeKind::Pose)
		newest--;
	const Eigen::Vector3d at = m_linearization.poses[newest].translation();
	std::vector<double> late;
	for (const int node : order)
		late.push_back(
			m_kinds[node] == ENodeKind::ErrorVariable
				? 1
				: -(m_linearization.poses[node].translation() - at).norm());
	return late;
}

/** e^T Omega e at the estimate, by the model at the linearisation. */
double CIncrementalOptimizer::estimatedS(const TFactorNormal& normal) const
{
	double s = normal.s;
	for (int a = 0; a < normal.count; a++) {
		const Vector6d& d_a = m_d[normal.node[a]];
		s += 2 * normal.g[a].dot(d_a) + d_a.dot(normal.H[TFactorNormal::lower(a, a)] * d_a);
		for (int b = 0; b < a; b++)
			s += 2 * d_a.dot(normal.H[TFactorNormal::lower(a, b)] * m_d[normal.node[b]]);
	}
	return std::max(s, 0.0);
}

TFactorNormal CIncrementalOptimizer::normalOf(const CPoseGraph& graph, int factor) const
{
	const auto [prior, index] = m_factors[factor];
	TFactorNormal normal = prior ? linearizePrior(graph.priors()[index], m_linearization)
								 : linearizeEdge(graph.edges()[index], m_linearization);
	const TRobustLoss& loss = prior ? graph.priors()[index].loss : graph.edges()[index].loss;
	const double weight = robustWeight(loss, loss.kind == ERobustLoss::None ? normal.s : estimatedS(normal));
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

void CIncrementalOptimizer::solve(CPoseGraph& graph, TIncrementalResult& result)
{
	Vector6d tolerance = Vector6d::Constant(m_options.solve_tolerance);
	tolerance.tail<3>() /= 10;	// a turn moves what is far away
	const std::vector<int>& solved = m_tree.solve(tolerance, m_d);
	for (const int node : solved) {
		moveNode(graph, node);
		if (m_is_moved[node] || m_d[node].lpNorm<Eigen::Infinity>() <= m_options.relinearize_step) continue;
		m_is_moved[node] = 1;
		m_moved.push_back(node);
	}
	result.solved = int(solved.size());
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
	const TOptimizerResult result = m_batch.optimize(graph);
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
	m_tree.solve(Vector6d::Zero(), m_d);
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
	std::fill(m_is_moved.begin(), m_is_moved.end(), 0);
	for (int node = 0; node < int(m_d.size()); node++) {
		m_d[node].setZero();
		if (m_free[node]) m_new_nodes.push_back(node);
	}
	for (int factor = 0; factor < int(m_factors.size()); factor++)
		if (m_factor_nodes[factor].count > 0) m_new_factors.push_back(factor);
}

CMarginals CIncrementalOptimizer::marginals() const
{
	return CMarginals(m_linearization.poses, m_tree);
}
}  // namespace posidonia
