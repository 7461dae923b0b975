#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/graphslam/CDistanceNRD.h>

namespace posidonia
{
using Eigen::Isometry3d;
using namespace mrpt::obs;

bool CDistanceNRD::updateState(CActionCollection::Ptr, CSensoryFrame::Ptr, CObservation::Ptr observation)
{
	const auto pair = std::dynamic_pointer_cast<CObservationStereoImages>(observation);
	if (!pair || !m_parts->odometry.ready()) return false;
	if (stampOf(*pair) < m_parts->odometry.stamp()) return false;  // late: the present has moved on
	if (m_parts->map.nodeCount() == 0) {
		registerRoot(stampOf(*pair));
		return true;
	}
	const TPoseEstimate since_node = m_parts->odometry.sinceClone();
	if (!m_distance.reached(since_node.T.translation().norm(), m_parts->options.node.distance)) return false;
	registerNode(stampOf(*pair), since_node);
	return true;
}

void CDistanceNRD::registerRoot(double stamp)
{
	const TPoseEstimate start = m_parts->odometry.now();  // map and odom start equal
	m_parts->map.root_covariance = start.cov;
	m_parts->map.addNode({stamp, start.T, {}, {}, {}}, start.T);
}

void CDistanceNRD::registerNode(double stamp, const TPoseEstimate& since_node)
{
	CSlamMap& map = m_parts->map;
	const int from = map.lastNode();
	map.addNode(
		{stamp, m_parts->odometry.now().T, {}, {}, m_parts->odometry.unary()}, map.pose(from) * since_node.T);
	map.addEdge(
		{from, from + 1, EEdgeKind::ODOMETRY, since_node.T, since_node.cov.inverse(),
		 since_node.path_length});
}

TSlamGraph::global_pose_t CDistanceNRD::getCurrentRobotPosEstimation() const
{
	const CSlamMap& map = m_parts->map;
	if (map.nodeCount() == 0) return {};
	const Isometry3d T_map_odom = map.pose(map.lastNode()) * map.node(map.lastNode()).T_odom_body.inverse();
	return TSlamGraph::global_pose_t(toMrpt(T_map_odom * m_parts->odometry.now().T));
}
}  // namespace posidonia
