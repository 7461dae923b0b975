#pragma once

#include <Eigen/Dense>
#include <vector>

namespace posidonia
{
/** A pose with its time. */
struct TStampedPose
{
	double stamp{0};  ///< UTC [s]
	Eigen::Isometry3d T{
		Eigen::Isometry3d::Identity()};	 ///< T_map_body (or of another frame pair: the owner says)
};

using TTrajectory = std::vector<TStampedPose>;
}  // namespace posidonia
