#include <posidonia/control/current_observer.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
using Eigen::Vector2d;

Vector2d CCurrentObserver::modelAcceleration(double yaw_rate) const
{
	const double u = m_through_water.x(), v = m_through_water.y();
	const double surge_drag =
		m_options.surge_linear_drag * u + m_options.surge_quadratic_drag * u * std::abs(u);
	const double sway_drag = m_options.sway_linear_drag * v + m_options.sway_quadratic_drag * v * std::abs(v);
	return {
		(m_thrust - surge_drag + m_options.sway_mass * v * yaw_rate) / m_options.surge_mass,
		(-sway_drag - m_options.surge_mass * u * yaw_rate) / m_options.sway_mass};
}

void CCurrentObserver::update(const TCurrentObservation& seen, double dt)
{
	m_thrust += std::min(1.0, dt / m_options.thruster_lag) * (seen.surge_force - m_thrust);
	m_through_water += dt * modelAcceleration(seen.yaw_rate);
	const Eigen::Rotation2Dd R_map_body(seen.heading);
	const Vector2d innovation = seen.velocity - m_through_water - R_map_body.inverse() * m_current;
	const double haste = m_through_water.x() / m_options.trusted_speed;
	const Vector2d gain(
		std::min(1.0, dt / m_options.surge_time) / (1 + haste * haste),
		std::min(1.0, dt / m_options.sway_time));
	m_current += R_map_body * gain.cwiseProduct(innovation);
	m_current = m_current.cwiseMax(-m_options.max_current).cwiseMin(m_options.max_current);
}

Vector2d CCurrentObserver::current() const
{
	const double speed = m_current.norm();
	if (!m_options.enabled || speed <= m_options.dead_zone) return Vector2d::Zero();
	// Continuous at the dead zone's edge, and nearly the whole estimate soon beyond it.
	const double part = m_options.dead_zone / speed;
	return m_current * (1 - part * part);
}
}  // namespace posidonia
