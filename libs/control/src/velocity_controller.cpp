#include <posidonia/control/velocity_controller.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
namespace
{
TPidGains gainsOf(const TVelocityControlOptions& options, size_t axis)
{
	return {
		options.gain[axis], options.integral_time[axis], options.derivative_time[axis],
		options.integral_limit[axis]};
}
}  // namespace

CVelocityController::CVelocityController(const TVelocityControlOptions& options)
	: m_options(options),
	  m_surge(gainsOf(options, 0)),
	  m_heave(gainsOf(options, 1)),
	  m_yaw(gainsOf(options, 2))
{
}

double CVelocityController::feedForward(size_t axis, double acceleration, double velocity, double dt)
{
	const double drag =
		(m_options.linear_drag[axis] + m_options.quadratic_drag[axis] * std::abs(velocity)) * velocity;
	const double force = m_options.inertia[axis] * acceleration + drag;
	double& filtered = m_filtered[axis];
	const double change = (force - filtered) / m_options.lead_filter;
	filtered += std::min(dt, m_options.lead_filter) * change;
	return force + (m_options.thruster_lag[axis] - m_options.lead_filter) * change;
}

TWrench CVelocityController::update(
	const TVelocityCommand& command, const TVelocityCommand& measured, const TVelocityCommand& acceleration,
	const TVelocityCommand& through_water, double dt)
{
	m_wanted.X = m_surge.update(command.surge, measured.surge, dt) +
				 feedForward(0, acceleration.surge, through_water.surge, dt);
	m_wanted.Z = m_heave.update(command.heave, measured.heave, dt) +
				 feedForward(1, acceleration.heave, through_water.heave, dt) + m_options.buoyancy;
	m_wanted.N = m_yaw.update(command.yaw_rate, measured.yaw_rate, dt) +
				 feedForward(2, acceleration.yaw_rate, through_water.yaw_rate, dt);
	return m_wanted;
}

void CVelocityController::noteAchieved(const TWrench& achieved)
{
	m_surge.noteSaturation(achieved.X - m_wanted.X);
	m_heave.noteSaturation(achieved.Z - m_wanted.Z);
	m_yaw.noteSaturation(achieved.N - m_wanted.N);
}

void CVelocityController::reset()
{
	m_surge.reset();
	m_heave.reset();
	m_yaw.reset();
	m_filtered = {0, 0, 0};
}
}  // namespace posidonia
