#include <posidonia/graphslam/CSparseGSO.h>

namespace posidonia
{
using namespace mrpt::obs;

CPoseGraph toPoseGraph(const CSlamMap& map, const TGraphLossOptions& loss, const TPriorOptions& priors)
{
	CPoseGraph graph;
	appendToGraph(graph, map, loss, priors);
	return graph;
}

void CSparseGSO::useParts(TSlamParts& parts)
{
	CUsesSlamParts::useParts(parts);
	parts.uncertainty = this;
	parts.make_exact = [this] { makeExact(); };
	const TOptimizerOptions& batch = parts.options.optimizer;
	if (parts.options.loss.incremental)
		m_incremental = std::make_unique<CIncrementalOptimizer>(parts.options.incremental, batch);
	else
		m_batch = std::make_unique<CSparseOptimizer>(batch);
}

bool CSparseGSO::updateState(CActionCollection::Ptr, CSensoryFrame::Ptr, CObservation::Ptr)
{
	m_just_optimized = false;
	if (follow()) optimizeGraph();
	return true;
}

bool CSparseGSO::follow()
{
	const CSlamMap& map = m_parts->map;
	const TRobustLoss loss = stereoLoss(m_parts->options.loss);
	for (; m_revised_seen < map.revisedEdges().size(); m_revised_seen++) {
		const int e = map.revisedEdges()[m_revised_seen];
		if (static_cast<size_t>(e) >= m_pose_graph.edgeCount()) continue;
		m_pose_graph.setEdge(e, toPoseEdge(map.edges()[static_cast<size_t>(e)], loss));
		m_changed_edges.push_back(e);
	}
	const bool stereo = appendToGraph(m_pose_graph, map, m_parts->options.loss, m_parts->options.priors);
	return stereo || !m_changed_edges.empty();
}

void CSparseGSO::optimizeGraph()
{
	const mrpt::system::CTimeLoggerEntry timing(m_parts->timer, "optimize");
	m_marginals.reset();
	if (m_incremental)
		updateIncrementally();
	else
		m_batch->optimize(m_pose_graph);
	handOver();
	m_changed_edges.clear();
	m_just_optimized = true;
}

/** Several nodes without a stereo edge may have come since. */
void CSparseGSO::updateIncrementally()
{
	m_incremental->update(m_pose_graph, m_changed_edges);
	m_followed_nodes = static_cast<int>(m_pose_graph.nodeCount());
}

void CSparseGSO::handOver()
{
	for (int n = 0; n < m_parts->map.nodeCount(); n++)
		m_parts->map.setPose(n, m_pose_graph.pose(n));
}

void CSparseGSO::makeExact()
{
	if (m_pose_graph.edgeCount() == 0) return;
	const mrpt::system::CTimeLoggerEntry timing(m_parts->timer, "make_exact");
	follow();
	m_marginals.reset();
	TOptimizerOptions options = m_parts->options.optimizer;
	options.min_relative_decrease =
		std::min(options.min_relative_decrease, TOptimizerOptions().min_relative_decrease);
	options.min_gradient = std::min(options.min_gradient, TOptimizerOptions().min_gradient);
	const TOptimizerResult result = CSparseOptimizer(options).optimize(m_pose_graph);
	handOver();
	std::vector<double> weights;
	for (size_t e = 0; e < m_pose_graph.edgeCount(); e++)
		weights.push_back(result.edge_weights[e] / m_pose_graph.edges()[e].loss.weight);
	m_parts->map.setWeights(weights);
}

std::vector<Matrix6d> CSparseGSO::relativeCovariances(const CSlamMap&, const std::vector<int>& is, int j)
{
	// One factorisation serves every decider of a step.
	if (m_incremental) {
		if (j >= m_followed_nodes) updateIncrementally();
		return m_incremental->marginals().relativeCovariances(is, j);
	}
	if (!m_marginals || j >= m_marginal_nodes) {
		m_marginals.reset();
		m_marginals.emplace(m_batch->marginals(m_pose_graph));
		m_marginal_nodes = static_cast<int>(m_pose_graph.nodeCount());
	}
	return m_marginals->relativeCovariances(is, j);
}
}  // namespace posidonia
