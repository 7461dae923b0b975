#include <posidonia/base/error.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/graphslam/slam_map.h>
#include <posidonia/vision/key_frame.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <queue>

namespace posidonia
{
using Eigen::Isometry3d;

const char* toString(EEdgeKind kind)
{
	switch (kind) {
		case EEdgeKind::ODOMETRY:
			return "odometry";
		case EEdgeKind::SEQUENTIAL:
			return "sequential";
		case EEdgeKind::ROI:
			return "roi";
	}
	return "?";
}

void CSlamMap::addNode(const TSlamNode& node, const Isometry3d& T_map_body)
{
	m_nodes.push_back(node);
	m_edges_of.emplace_back();
	setPose(lastNode(), T_map_body);
}

void CSlamMap::addEdge(const TSlamEdge& edge)
{
	m_edges_of[static_cast<size_t>(edge.from)].push_back(static_cast<int>(m_edges.size()));
	m_edges_of[static_cast<size_t>(edge.to)].push_back(static_cast<int>(m_edges.size()));
	m_edges.push_back(edge);
	m_graph->insertEdgeAtEnd(
		static_cast<mrpt::graphs::TNodeID>(edge.from), static_cast<mrpt::graphs::TNodeID>(edge.to),
		toMrptGaussianInf(edge.T_from_to, edge.share * edge.information));
}

void CSlamMap::writeToMrpt(int index)
{
	const TSlamEdge& edge = m_edges[static_cast<size_t>(index)];
	const auto ids = std::make_pair(
		static_cast<mrpt::graphs::TNodeID>(edge.from), static_cast<mrpt::graphs::TNodeID>(edge.to));
	// MRPT's graph keeps edges between two nodes in the order of their coming.
	auto found = m_graph->edges.lower_bound(ids);
	for (int other : m_edges_of[static_cast<size_t>(edge.from)]) {
		const TSlamEdge& o = m_edges[static_cast<size_t>(other)];
		if (other < index && o.from == edge.from && o.to == edge.to) ++found;
	}
	found->second = toMrptGaussianInf(edge.T_from_to, edge.share * edge.information);
}

void CSlamMap::setShare(int index, double share)
{
	m_edges[static_cast<size_t>(index)].share = share;
	m_revised.push_back(index);
	writeToMrpt(index);
}

void CSlamMap::shareInformation()
{
	/** A share that is nearer than this to the one in use stays: each revision costs the optimiser. */
	constexpr double kTolerance = 0.05;
	for (; m_edges_shared < m_edges.size(); m_edges_shared++) {
		const TSlamEdge& edge = m_edges[m_edges_shared];
		if (edge.points.empty()) continue;
		m_shared_points.addEdge(edge.from, edge.to, edge.points);
		m_stereo_edges.push_back(static_cast<int>(m_edges_shared));
	}
	for (const int k : m_shared_points.takeTouched()) {
		const int index = m_stereo_edges[static_cast<size_t>(k)];
		const double now = m_edges[static_cast<size_t>(index)].share, share = m_shared_points.share(k);
		if (std::abs(share - now) > kTolerance * now) setShare(index, share);
	}
}

void CSlamMap::reviseOdometry(int to, const TPoseEstimate& revised, const Isometry3d& T_odom_body)
{
	const auto& at_node = m_edges_of.at(static_cast<size_t>(to));
	const auto found = std::find_if(at_node.begin(), at_node.end(), [&](int e) {
		const TSlamEdge& edge = m_edges[static_cast<size_t>(e)];
		return edge.kind == EEdgeKind::ODOMETRY && edge.to == to;
	});
	if (found == at_node.end())
		throw CError("node " + std::to_string(to), "no odometry edge ends there", "revise a later node");
	TSlamEdge& edge = m_edges[static_cast<size_t>(*found)];
	edge.T_from_to = revised.T;
	edge.information = revised.cov.inverse();
	edge.path_length = revised.path_length;
	m_nodes[static_cast<size_t>(to)].T_odom_body = T_odom_body;
	m_revised.push_back(*found);
	writeToMrpt(*found);
}

void CSlamMap::setKeyFrame(int i, std::shared_ptr<const TKeyFrame> key_frame)
{
	TSlamNode& node = m_nodes[static_cast<size_t>(i)];
	node.places.clear();
	std::map<std::pair<double, double>, int> first;
	for (const TStereoPoint& p : key_frame->points)
		node.places.push_back(
			first.emplace(std::make_pair(p.uvr.x(), p.uvr.y()), static_cast<int>(node.places.size()))
				.first->second);
	node.key_frame = std::move(key_frame);
}

Isometry3d CSlamMap::pose(int i) const
{
	return fromMrpt(m_graph->nodes.at(static_cast<mrpt::graphs::TNodeID>(i)));
}

void CSlamMap::setPose(int i, const Isometry3d& T_map_body)
{
	m_graph->nodes[static_cast<mrpt::graphs::TNodeID>(i)] = TSlamGraph::global_pose_t(toMrpt(T_map_body));
}

std::vector<double> CSlamMap::odometryMetresTo(int to) const
{
	// Dijkstra with the metres of odometry edges for lengths.
	std::vector<double> metres(m_nodes.size(), std::numeric_limits<double>::infinity());
	using TItem = std::pair<double, int>;
	std::priority_queue<TItem, std::vector<TItem>, std::greater<>> open;
	metres[static_cast<size_t>(to)] = 0;
	open.push({0, to});
	while (!open.empty()) {
		const auto [d, i] = open.top();
		open.pop();
		if (d > metres[static_cast<size_t>(i)]) continue;
		for (int e : m_edges_of[static_cast<size_t>(i)]) {
			const TSlamEdge& edge = m_edges[static_cast<size_t>(e)];
			const int k = edge.from == i ? edge.to : edge.from;
			const double through = d + (edge.kind == EEdgeKind::ODOMETRY ? edge.path_length : 0);
			if (through >= metres[static_cast<size_t>(k)]) continue;
			metres[static_cast<size_t>(k)] = through;
			open.push({through, k});
		}
	}
	return metres;
}

void CSlamMap::setWeights(const std::vector<double>& weights)
{
	std::map<std::pair<int, int>, double> of_pair;
	for (size_t e = 0; e < m_edges.size(); e++)
		if (m_edges[e].kind != EEdgeKind::ODOMETRY) of_pair[{m_edges[e].from, m_edges[e].to}] = weights[e];
	for (TCandidateRow& row : candidates) {
		const auto found = of_pair.find({row.from, row.to});
		if (row.accepted() && found != of_pair.end()) row.weight = found->second;
	}
}

std::string candidatesCsv(const std::vector<TCandidateRow>& rows)
{
	std::string csv = "from,to,kind,status,matches,inliers,rmse_px,tx,ty,tz,qx,qy,qz,qw,weight\n";
	char line[512];
	for (const auto& row : rows) {
		std::snprintf(
			line, sizeof line, "%d,%d,%s,%s,%d,%d,%.6f", row.from, row.to, toString(row.kind),
			row.status.c_str(), row.matches, row.inliers, row.rmse_px);
		csv += line;
		if (row.measured) {
			const Eigen::Vector3d t = row.T_from_to.translation();
			const Eigen::Quaterniond q(row.T_from_to.linear());
			std::snprintf(
				line, sizeof line, ",%.9f,%.9f,%.9f,%.12f,%.12f,%.12f,%.12f", t.x(), t.y(), t.z(), q.x(),
				q.y(), q.z(), q.w());
			csv += line;
		}
		else {
			csv += ",,,,,,,";
		}
		std::snprintf(line, sizeof line, row.accepted() ? ",%.4f\n" : ",\n", row.weight);
		csv += line;
	}
	return csv;
}
}  // namespace posidonia
