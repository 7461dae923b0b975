#include <posidonia/control/safe_correction.h>

#include <algorithm>

namespace posidonia
{
using Eigen::Isometry3d;

namespace
{
// Less than this is rounding: the target is taken as it is.
constexpr double kNothing = 1e-9;

/** The part of a step of `length` that a bound allows. */
double allowed(double length, double bound)
{
	return length > bound ? bound / length : 1;
}
}  // namespace

void CSafeCorrection::advance(double stamp, const Isometry3d& T_odom_body)
{
	const double dt = m_started ? std::max(0.0, stamp - m_stamp) : 0;
	if (!m_started) m_applied = m_target;
	m_started = true;
	m_stamp = stamp;

	const Isometry3d target = m_target * T_odom_body;
	Vector6d step = localCoordinates(m_applied * T_odom_body, target);
	step.head<3>() *= allowed(step.head<3>().norm(), m_options.position_rate * dt);
	step.tail<3>() *= allowed(step.tail<3>().norm(), m_options.rotation_rate * dt);
	m_pose = orthonormalized(retract(m_applied * T_odom_body, step));
	m_remaining = localCoordinates(m_pose, target);
	m_correcting = m_remaining.norm() > kNothing;
	if (!m_correcting) m_pose = target;
	m_applied = m_correcting ? m_pose * T_odom_body.inverse() : m_target;
}
}  // namespace posidonia
