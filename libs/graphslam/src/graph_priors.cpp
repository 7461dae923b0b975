#include <posidonia/graphslam/graph_priors.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
double varianceAmongMany(double sigma, double lasting, double time, double interval)
{
	const double together = interval > 0 ? std::max(1.0, 2 * time / interval) : 1.0;
	return sigma * sigma - lasting * lasting + lasting * lasting * together;
}

TRobustLoss stereoLoss(const TGraphLossOptions& options)
{
	if (options.loss == "none") return {};
	TRobustLoss loss{options.loss == "huber" ? ERobustLoss::Huber : ERobustLoss::Cauchy, options.scale};
	loss.weight = honestFactor(loss, 6);
	return loss;
}

TPoseEdge toPoseEdge(const TSlamEdge& edge, const TRobustLoss& loss)
{
	TPoseEdge e;
	e.from = edge.from;
	e.to = edge.to;
	e.T_from_to = edge.T_from_to;
	e.information = (0.5 * edge.share) * (edge.information + edge.information.transpose());
	if (edge.kind == EEdgeKind::ODOMETRY) return e;
	// An edge is an outlier by its own information: share * rho(s) of the unshared s.
	e.loss = loss;
	e.loss.scale *= std::sqrt(edge.share);
	return e;
}

namespace
{
/** A prior of `kind` at the node with these variances of its residual. */
TPosePrior priorOf(
	int node, EPriorKind kind, const Eigen::Isometry3d& measured, std::initializer_list<double> variances)
{
	TPosePrior prior;
	prior.node = node;
	prior.kind = kind;
	prior.T_map_node = measured;
	int row = 0;
	for (const double variance : variances)
		prior.information(row, row) = 1 / variance, row++;
	return prior;
}

void addRootPrior(CPoseGraph& graph, const CSlamMap& map)
{
	TPosePrior prior;
	prior.node = 0;
	prior.kind = EPriorKind::FullPose;
	prior.T_map_node = map.node(0).T_odom_body;
	// A known start may be told with a sigma of 0.
	prior.information = (map.root_covariance + 1e-12 * Matrix6d::Identity()).inverse();
	prior.information = (0.5 * (prior.information + prior.information.transpose())).eval();
	graph.addPrior(prior);
}

void addPriors(CPoseGraph& graph, const CSlamMap& map, int node, const TPriorOptions& options)
{
	const TUnaryMeasurements& m = map.node(node).measured;
	const double interval = map.node(node).stamp - map.node(node - 1).stamp;
	Eigen::Isometry3d at = Eigen::Isometry3d::Identity();
	if (m.depth && options.depth) {
		at.translation().z() = m.depth->value;
		graph.addPrior(priorOf(
			node, EPriorKind::Depth, at,
			{varianceAmongMany(m.depth->sigma, m.depth->lasting, m.depth->lasting_time, interval)}));
	}
	if (m.position && options.position) {
		at.translation().head<2>() = m.position->value;
		const double variance =
			varianceAmongMany(m.position->sigma, m.position->lasting, m.position->lasting_time, interval);
		graph.addPrior(priorOf(node, EPriorKind::HorizontalPosition, at, {variance, variance}));
	}
	if (!m.attitude) return;
	at.linear() = m.attitude->R_map_body;
	const double tilt = varianceAmongMany(
					 m.attitude->sigma_roll_pitch, m.attitude->lasting_roll_pitch, m.attitude->lasting_time,
					 interval),
				 heading = varianceAmongMany(
					 m.attitude->sigma_heading, m.attitude->lasting_heading, m.attitude->lasting_time,
					 interval);
	if (options.roll_pitch) graph.addPrior(priorOf(node, EPriorKind::RollPitch, at, {tilt, tilt}));
	if (options.heading) graph.addPrior(priorOf(node, EPriorKind::Heading, at, {heading}));
}
}  // namespace

bool appendToGraph(
	CPoseGraph& graph, const CSlamMap& map, const TGraphLossOptions& loss, const TPriorOptions& priors)
{
	bool stereo = false;
	for (auto n = static_cast<int>(graph.nodeCount()); n < map.nodeCount(); n++) {
		graph.addNode(map.pose(n), n == 0 && !priors.root);
		if (n > 0)
			addPriors(graph, map, n, priors);
		else if (priors.root)
			addRootPrior(graph, map);
	}
	const TRobustLoss stereo_loss = stereoLoss(loss);
	for (size_t e = graph.edgeCount(); e < map.edges().size(); e++) {
		graph.addEdge(toPoseEdge(map.edges()[e], stereo_loss));
		stereo = stereo || map.edges()[e].kind != EEdgeKind::ODOMETRY;
	}
	return stereo;
}
}  // namespace posidonia
