#pragma once

#include <posidonia/geometry/se3.h>

#include <deque>
#include <optional>

namespace posidonia
{
/** A correction as SLAM hands it out. */
struct TCorrection
{
	double stamp{0};  ///< Of the stereo pair that caused it [s]
	Eigen::Isometry3d T_map_odom{Eigen::Isometry3d::Identity()};
	Matrix6d cov{Matrix6d::Zero()};	 ///< Of T_map_body at `stamp`, handed through
};

/** SLAM takes time: what is pushed at t is seen from t + latency on. As T_map_odom is composed with the
 * odometry of the present, the motion since t is in the pose. */
class CDelayedCorrections
{
   public:
	/** `latency` [s] >= 0. */
	explicit CDelayedCorrections(double latency) : m_latency(latency) {}
	/** Stamps must not decrease. */
	void push(const TCorrection& correction);
	/** The newest correction that became visible since the last call, if any. */
	std::optional<TCorrection> takeVisible(double now);

   private:
	double m_latency;
	std::deque<TCorrection> m_queue;
};
}  // namespace posidonia
