#include <posidonia/control/pid.h>

#include <algorithm>

namespace posidonia
{
namespace
{
constexpr double kLongestGap = 0.2;	 // [s] (COLA2)
}

void CPid::reset()
{
	m_integral = 0;
	m_saturation = 0;
	m_started = false;
}

double CPid::update(double set_point, double feedback, double dt)
{
	if (dt > kLongestGap) reset();
	const double error = set_point - feedback;
	const bool first = !m_started || dt <= 0;
	const bool winds_up = error * m_saturation < 0;
	if (!first && !winds_up)
		m_integral = std::clamp(
			m_integral + m_gains.gain / m_gains.integral_time * error * dt, -m_gains.integral_limit,
			m_gains.integral_limit);
	const double slope = first ? 0 : (feedback - m_feedback) / dt;
	m_feedback = feedback;
	m_started = true;
	return m_gains.gain * (error - m_gains.derivative_time * slope) + m_integral;
}
}  // namespace posidonia
