#include <posidonia/base/error.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/graphslam/slam_map.h>

#include <algorithm>
#include <cstdio>
#include <limits>
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
		toMrptGaussianInf(edge.T_from_to, edge.information));
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
	// MRPT's graph keeps edges between two nodes in the order of their coming: odometry comes first.
	const auto ids = std::make_pair(
		static_cast<mrpt::graphs::TNodeID>(edge.from), static_cast<mrpt::graphs::TNodeID>(edge.to));
	m_graph->edges.lower_bound(ids)->second = toMrptGaussianInf(edge.T_from_to, edge.information);
}

void CSlamMap::setKeyFrame(int i, std::shared_ptr<const TKeyFrame> key_frame)
{
	m_nodes[static_cast<size_t>(i)].key_frame = std::move(key_frame);
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

std::string candidatesCsv(const std::vector<TCandidateRow>& rows)
{
	std::string csv = "from,to,kind,status,matches,inliers,rmse_px,tx,ty,tz,qx,qy,qz,qw\n";
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
		csv += "\n";
	}
	return csv;
}
}  // namespace posidonia
