#pragma once

#include <posidonia/base/options.h>
#include <posidonia/geometry/se3.h>

namespace posidonia
{
/** Section [ControllerPose]. */
struct TControllerPoseOptions
{
	double position_rate{0.05};
	double rotation_rate{2 * M_PI / 180};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"position_rate", position_rate, above(0),
			"A correction moves the controller's position by at most this [m/s]");
		v.degrees(
			"rotation_rate", rotation_rate, above(0),
			"... and turns its heading, roll and pitch by at most this [deg/s]");
	}
};

/** The controller-safe pose. SLAM's T_map_odom jumps when a loop closes; the controller's own one follows it
 * at bounded rates. What is bounded is the motion of the *vehicle's* pose: turning T_map_odom about the
 * origin would swing a vehicle that is 12 m away by 0.2 m a degree.
 *
 *   safe.setTarget(T_map_odom);                      // when a correction becomes known
 *   safe.advance(stamp, T_odom_body);                // at each controller step
 *   T_map_body = safe.T_map_odom() * T_odom_body;    // = safe.T_map_body()
 */
class CSafeCorrection
{
   public:
	explicit CSafeCorrection(const TControllerPoseOptions& options) : m_options(options) {}

	/** The correction to move to from the next advance() on. */
	void setTarget(const Eigen::Isometry3d& T_map_odom) { m_target = T_map_odom; }

	/** Moves towards the target for the time since the last call (none at the first call, which takes the
	 * target as it is). Stamps [s] must not decrease. */
	void advance(double stamp, const Eigen::Isometry3d& T_odom_body);

	const Eigen::Isometry3d& T_map_odom() const { return m_applied; }
	const Eigen::Isometry3d& T_map_body() const { return m_pose; }
	/** Is a part of the correction still to be applied? */
	bool correcting() const { return m_correcting; }
	/** What is still to be applied, at the vehicle: retract(T_map_body(), d) is the map's pose. */
	const Vector6d& remaining() const { return m_remaining; }
	/** The map's pose covariance grown by the part not yet applied: cov + d d^T, its second moment. */
	Matrix6d covariance(const Matrix6d& cov) const { return cov + m_remaining * m_remaining.transpose(); }

   private:
	TControllerPoseOptions m_options;
	Eigen::Isometry3d m_target{Eigen::Isometry3d::Identity()}, m_applied{Eigen::Isometry3d::Identity()},
		m_pose{Eigen::Isometry3d::Identity()};
	Vector6d m_remaining{Vector6d::Zero()};
	double m_stamp{0};
	bool m_started{false}, m_correcting{false};
};
}  // namespace posidonia
