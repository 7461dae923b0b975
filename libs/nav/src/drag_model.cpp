#include <posidonia/nav/drag_model.h>

#include <cmath>

namespace posidonia
{
namespace
{
double drag(double v, double linear, double quadratic)
{
	return linear * v + quadratic * v * std::abs(v);
}
}  // namespace

void CDragModel::start(const Eigen::Vector3d& velocity)
{
	m_velocity = velocity;
	m_thrust = drag(velocity.x(), m_options.linear_surge, m_options.quadratic_surge);
}

void CDragModel::advance(double dt)
{
	const TDragOptions& o = m_options;
	constexpr double kStep = 0.1;  // far below the time constants, mass / drag: seconds
	for (double left = dt; left > 0; left -= kStep) {
		const double h = std::min(left, kStep);
		double &u = m_velocity.x(), &v = m_velocity.y(), &w = m_velocity.z();
		u += h * (m_thrust - drag(u, o.linear_surge, o.quadratic_surge)) / o.mass_surge;
		v -= h * drag(v, o.linear_sway, o.quadratic_sway) / o.mass_sway;
		w -= h * drag(w, o.linear_heave, o.quadratic_heave) / o.mass_heave;
	}
}

Eigen::Vector3d CDragModel::sigmaOfReading(double period) const
{
	return std::sqrt(2 * m_options.correlation_time / period) *
		   Eigen::Vector3d(m_options.sigma_surge, m_options.sigma_sway, m_options.sigma_heave);
}
}  // namespace posidonia
