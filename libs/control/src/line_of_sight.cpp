#include <posidonia/control/line_of_sight.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
double CLineOfSight::course(double cross) const
{
	return -std::atan2(cross + m_integral, m_options.look_ahead);
}

double CLineOfSight::courseRate(double cross, double cross_rate) const
{
	const double delta = m_options.look_ahead;
	const double reached = cross + m_integral;
	return -delta * cross_rate / (reached * reached + delta * delta);
}

double CLineOfSight::update(double cross, double dt)
{
	const double delta = m_options.look_ahead;
	const double reached = cross + m_integral;
	const double rate = m_options.integral_gain * delta * cross / (reached * reached + delta * delta);
	m_integral = std::clamp(m_integral + rate * dt, -m_options.integral_limit, m_options.integral_limit);
	return course(cross);
}
}  // namespace posidonia
