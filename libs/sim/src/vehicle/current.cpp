#include <posidonia/sim/current.h>
#include <posidonia/sim/smooth_profile.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
int stepsAKnot(const TCurrentOptions& o, double step)
{
	return std::max(1, static_cast<int>(std::min(1e9, std::round(o.gust_time / 10 / step))));
}
}  // namespace

CCurrent::CCurrent(const TCurrentOptions& o, double step, uint64_t seed)
	: m_steps_a_knot(stepsAKnot(o, step)),
	  m_step(step),
	  m_gusts(Vector2d::Constant(o.gust_speed), o.gust_time, m_steps_a_knot * step, seedOf(seed, "gusts")),
	  m_gust_before(m_gusts.value()),
	  m_onset(o.onset)
{
	const Vector3d direction(std::cos(o.direction), std::sin(o.direction), 0);
	m_at_surface = o.speed * direction;
	m_shear = o.shear * direction;
	m_gusts.advance();
	m_gust_after = m_gusts.value();
}

void CCurrent::advance()
{
	m_steps++;
	if (m_steps < m_knot_step + m_steps_a_knot) return;
	m_knot_step = m_steps;
	m_gust_before = m_gust_after;
	m_gusts.advance();
	m_gust_after = m_gusts.value();
}

void CCurrent::setAdded(double t, const Vector3d& velocity)
{
	m_added_before = m_added + (m_added_before - m_added) * std::exp((m_added_since - t) / m_onset);
	m_added = velocity;
	m_added_since = t;
}

TWaterMotion CCurrent::at(double t, double depth) const
{
	TWaterMotion water;
	const Vector3d to_come = (m_added_before - m_added) * std::exp((m_added_since - t) / m_onset);
	water.velocity = m_at_surface + depth * m_shear + m_added + to_come;
	water.acceleration = -to_come / m_onset;
	water.shear = m_shear;
	addGust(t, water);
	return water;
}

void CCurrent::addGust(double t, TWaterMotion& water) const
{
	const double since_knot = t - static_cast<double>(m_knot_step) * m_step;
	const TProfileValue way = minimumJerkStep(since_knot, m_steps_a_knot * m_step);
	const Vector2d change = m_gust_after - m_gust_before;
	water.velocity.head<2>() += m_gust_before + way.value * change;
	water.acceleration.head<2>() += way.rate * change;
}
}  // namespace posidonia
