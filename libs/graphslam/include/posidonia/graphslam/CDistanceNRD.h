#pragma once

#include <mrpt/graphslam/interfaces/CNodeRegistrationDecider.h>
#include <posidonia/graphslam/node_distance.h>
#include <posidonia/graphslam/slam_parts.h>

namespace posidonia
{
/** Node registration (paper, sec. 3.2): a node at the first stereo pair whose 3D displacement from the last
 * node is at least the wanted distance less half the step between pairs (so that nodes are the wanted
 * distance apart on average), and its odometry edge. The root is the first stereo pair, at the pose that the
 * odometry has then. */
class CDistanceNRD : public mrpt::graphslam::deciders::CNodeRegistrationDecider<TSlamGraph>,
					 public CUsesSlamParts
{
   public:
	/** True when a node was added. */
	bool updateState(
		mrpt::obs::CActionCollection::Ptr action, mrpt::obs::CSensoryFrame::Ptr observations,
		mrpt::obs::CObservation::Ptr observation) override;

	/** T_map_body: the last node's pose, moved on by the odometry since. */
	TSlamGraph::global_pose_t getCurrentRobotPosEstimation() const override;

   private:
	void registerRoot(double stamp);
	void registerNode(double stamp, const TPoseEstimate& since_node);

	CNodeDistance m_distance;
};
}  // namespace posidonia
