#include <posidonia/control/pose_controller.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
namespace
{
double stepTowards(double now, double wanted, double limit, double step)
{
	return std::clamp(std::clamp(wanted, -limit, limit), now - step, now + step);
}
}  // namespace

TVelocityCommand CPoseController::command(
	const TGuidanceCommand& guidance, const TControlState& navigation) const
{
	TVelocityCommand command;
	command.surge = guidance.surge;
	command.yaw_rate = guidance.heading.rate +
					   m_options.heading_gain * wrapAngle(guidance.heading.value - navigation.heading());
	const double down =
		guidance.depth.rate + m_options.depth_gain * (guidance.depth.value - navigation.depth());
	const double pitch = navigation.pitch();
	// Close to vertical heave does nothing for the depth: bounded.
	command.heave = (down + navigation.v_body.x() * std::sin(pitch)) / std::max(0.5, std::cos(pitch));
	return command;
}

TVelocityCommand CPoseController::limited(const TVelocityCommand& wanted, double dt)
{
	m_last.surge =
		stepTowards(m_last.surge, wanted.surge, m_options.max_surge, m_options.max_surge_acceleration * dt);
	m_last.heave =
		stepTowards(m_last.heave, wanted.heave, m_options.max_heave, m_options.max_heave_acceleration * dt);
	m_last.yaw_rate = stepTowards(
		m_last.yaw_rate, wanted.yaw_rate, m_options.max_yaw_rate, m_options.max_yaw_acceleration * dt);
	return m_last;
}
}  // namespace posidonia
