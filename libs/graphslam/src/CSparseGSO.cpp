#include <posidonia/graphslam/CSparseGSO.h>

#include <cmath>

namespace posidonia
{
using namespace mrpt::obs;

namespace
{
TPoseEdge toPoseEdge(const TSlamEdge& edge, const TGraphLossOptions& loss)
{
	TPoseEdge e;
	e.from = edge.from;
	e.to = edge.to;
	e.T_from_to = edge.T_from_to;
	e.information = (0.5 * edge.share) * (edge.information + edge.information.transpose());
	if (edge.kind == EEdgeKind::ODOMETRY || loss.loss == "none") return e;
	// An edge is an outlier by its own information: share * rho(s) of the unshared s.
	const double scale = loss.scale * std::sqrt(edge.share);
	e.loss = {loss.loss == "huber" ? ERobustLoss::Huber : ERobustLoss::Cauchy, scale};
	return e;
}

/** Appends what the map has more than the graph. True when a stereo edge is among it. */
bool append(CPoseGraph& graph, const CSlamMap& map, const TGraphLossOptions& loss)
{
	bool stereo = false;
	for (auto n = static_cast<int>(graph.nodeCount()); n < map.nodeCount(); n++)
		graph.addNode(map.pose(n), n == 0);
	for (size_t e = graph.edgeCount(); e < map.edges().size(); e++) {
		graph.addEdge(toPoseEdge(map.edges()[e], loss));
		stereo = stereo || map.edges()[e].kind != EEdgeKind::ODOMETRY;
	}
	return stereo;
}
}  // namespace

CPoseGraph toPoseGraph(const CSlamMap& map, const TGraphLossOptions& loss)
{
	CPoseGraph graph;
	append(graph, map, loss);
	return graph;
}

void CSparseGSO::useParts(TSlamParts& parts)
{
	CUsesSlamParts::useParts(parts);
	parts.uncertainty = this;
	m_optimizer = std::make_unique<CSparseOptimizer>(parts.options.optimizer);
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
	const bool revised = m_revised_seen < map.revisedEdges().size();
	for (; m_revised_seen < map.revisedEdges().size(); m_revised_seen++) {
		const int e = map.revisedEdges()[m_revised_seen];
		if (static_cast<size_t>(e) < m_pose_graph.edgeCount())
			m_pose_graph.setEdge(e, toPoseEdge(map.edges()[static_cast<size_t>(e)], m_parts->options.loss));
	}
	return append(m_pose_graph, map, m_parts->options.loss) || revised;
}

void CSparseGSO::optimizeGraph()
{
	const mrpt::system::CTimeLoggerEntry timing(m_parts->timer, "optimize");
	m_marginals.reset();
	m_optimizer->optimize(m_pose_graph);
	for (int n = 0; n < m_parts->map.nodeCount(); n++)
		m_parts->map.setPose(n, m_pose_graph.pose(n));
	m_just_optimized = true;
}

std::vector<Matrix6d> CSparseGSO::relativeCovariances(const CSlamMap&, const std::vector<int>& is, int j)
{
	// One factorisation serves every decider of a step.
	if (!m_marginals || j >= m_marginal_nodes) {
		m_marginals.reset();
		m_marginals.emplace(m_optimizer->marginals(m_pose_graph));
		m_marginal_nodes = static_cast<int>(m_pose_graph.nodeCount());
	}
	return m_marginals->relativeCovariances(is, j);
}
}  // namespace posidonia
