#include <posidonia/sim/smooth_profile.h>

#include <algorithm>

namespace posidonia
{
TProfileValue minimumJerkStep(double t, double duration)
{
	if (t <= 0) return {0, 0, 0};
	if (t >= duration) return {1, 0, 0};
	const double x = t / duration, y = 1 - x;
	return {
		x * x * x * (10 - 15 * x + 6 * x * x), 30 * x * x * y * y / duration,
		60 * x * y * (1 - 2 * x) / (duration * duration)};
}

namespace
{
/** Integral of the step from 0 to t <= duration. */
double integralOfStep(double t, double duration)
{
	const double x = t / duration;
	return duration * x * x * x * x * (2.5 - 3 * x + x * x);
}
}  // namespace

CLegProfile::CLegProfile(double length, double speed, double acceleration) : m_length(length)
{
	if (length <= 0) return;
	m_ramp = kMinimumJerkPeak * speed / acceleration;
	m_speed = std::min(speed, length / m_ramp);	 // both ramps together cover speed * ramp
	m_cruise = length / m_speed - m_ramp;
}

TProfileValue CLegProfile::at(double t) const
{
	if (t <= 0 || m_length <= 0) return {};
	if (t >= duration()) return {m_length, 0, 0};
	if (t > m_ramp + m_cruise)	// the end is the start backwards
	{
		const TProfileValue mirrored = at(duration() - t);
		return {m_length - mirrored.value, mirrored.rate, -mirrored.acceleration};
	}
	if (t > m_ramp) return {m_speed * (t - m_ramp / 2), m_speed, 0};
	const TProfileValue step = minimumJerkStep(t, m_ramp);
	return {m_speed * integralOfStep(t, m_ramp), m_speed * step.value, m_speed * step.rate};
}
}  // namespace posidonia
