#include <posidonia/control/references.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
namespace
{
// Peaks of the first and second derivative of the minimum-jerk step 10 x^3 - 15 x^4 + 6 x^5 over 0..1.
constexpr double kPeakRate = 1.875;
const double kPeakAcceleration = 10 / std::sqrt(3.0);
}  // namespace

CTurnProfile::CTurnProfile(double from, double angle, double peak_rate, double peak_acceleration)
	: m_from(from),
	  m_angle(angle),
	  m_duration(std::max(
		  kPeakRate * std::abs(angle) / peak_rate,
		  std::sqrt(kPeakAcceleration * std::abs(angle) / peak_acceleration)))
{
}

TReference CTurnProfile::at(double t) const
{
	if (t <= 0 || m_duration <= 0) return {m_from + (m_duration <= 0 ? m_angle : 0), 0, 0};
	if (t >= m_duration) return {m_from + m_angle, 0, 0};
	const double x = t / m_duration;
	return {
		m_from + m_angle * x * x * x * (10 + x * (-15 + 6 * x)),
		m_angle / m_duration * 30 * x * x * (1 - x) * (1 - x),
		m_angle / (m_duration * m_duration) * 60 * x * (1 + x * (-3 + 2 * x))};
}

const TReference& CSmoothReference::update(double target, double max_rate, double max_acceleration, double dt)
{
	if (dt <= 0) return m_now;
	const double distance = target - m_now.value;
	// The rate that can still be braked, one step of delay allowed for: v dt + v^2 / (2 a) = distance.
	const double a_dt = max_acceleration * dt;
	const double brakable = std::sqrt(a_dt * a_dt + 2 * max_acceleration * std::abs(distance)) - a_dt;
	const double wanted = std::copysign(std::min({max_rate, brakable, std::abs(distance) / dt}), distance);
	const double rate = std::clamp(wanted, m_now.rate - a_dt, m_now.rate + a_dt);
	m_now = {m_now.value + rate * dt, rate, (rate - m_now.rate) / dt};
	return m_now;
}
}  // namespace posidonia
