#pragma once

#include <posidonia/geometry/trajectory.h>

#include <string>

namespace posidonia
{
/** Plain dead reckoning of a rawlog: DVL velocities turned by the AHRS' attitude and summed by the trapezoid
 * rule, no filter.
 *
 *   p_dvl(k) = p_dvl(k-1) + (R_k v_k + R_{k-1} v_{k-1}) / 2 (t_k - t_{k-1}),   R_k = R_map_body(t_k)
 * R_body_dvl T_map_body(k) = (p_dvl(k) - R_map_body(t_k) t_body_dvl, R_map_body(t_k))
 *
 * R_map_body(t) lies on the great circle between the attitudes before and after t (one at t is taken as it
 * is); pings without an attitude on both sides, or without bottom lock, are left out. What it is good for: a
 * measure of a log, and what a filter must beat.
 *
 * @param start position of the body at the first pose, in map [m]
 * @return T_map_body at every ping that is used, UTC [s]
 * Throws CError when the file is no rawlog, or no ping of `dvl` has an attitude of `ahrs` (sensorLabels). */
TTrajectory deadReckoning(
	const std::string& rawlog, const Eigen::Vector3d& start = Eigen::Vector3d::Zero(),
	const std::string& dvl = "DVL", const std::string& ahrs = "AHRS");
}  // namespace posidonia
