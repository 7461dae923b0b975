#pragma once

#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/observations.h>

namespace posidonia
{
/** An observation with its label, stamp (UTC [s]) and pose filled in. */
template <class OBSERVATION>
typename OBSERVATION::Ptr makeObservation(
	const std::string& label, double stamp, const Eigen::Isometry3d& T_body_sensor)
{
	auto observation = OBSERVATION::Create();
	observation->sensorLabel = label;
	observation->timestamp = stampFrom(stamp);
	observation->sensorPose = toMrpt(T_body_sensor);
	return observation;
}
}  // namespace posidonia
