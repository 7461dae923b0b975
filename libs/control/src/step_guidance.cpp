#include <posidonia/control/step_guidance.h>

#include <algorithm>

namespace posidonia
{
using Eigen::Vector2d;

void CStepGuidance::begin(
	const TStep& step, const std::optional<Vector2d>& before, const TControlState& navigation,
	const Vector2d& current)
{
	const Vector2d here = navigation.horizontal();
	if (!m_started) {
		m_command.heading = {navigation.heading(), 0, 0};
		m_depth_reference.reset(navigation.depth());
		m_started = true;
	}
	m_step = step;
	m_begun = navigation.stamp;
	m_end = step.has_end ? step.end : before.value_or(here);
	m_depth_target = m_depth.target(step, navigation);
	m_climb = std::abs(m_depth_target - navigation.depth());
	if (!step.isLeg()) return;
	const Vector2d start = step.kind == EStepKind::SECTION ? before.value_or(here) : here;
	m_leg.begin(start, m_end, step.speed, navigation, current, m_command.heading.value);
}

void CStepGuidance::rampSurge(double wanted, double dt)
{
	const double step = m_options.acceleration * dt;
	const double change = std::clamp(wanted - m_command.surge, -step, step);
	m_command.surge += change;
	m_command.surge_rate = dt > 0 ? change / dt : 0;
}

void CStepGuidance::keepStation(const TControlState& navigation, const Vector2d& current, double dt)
{
	const TSteering steering =
		m_station.update(m_end - navigation.horizontal(), current, navigation.heading());
	const double step = m_options.station_turn_rate * dt;
	const double heading = m_command.heading.value;
	m_command.heading = {heading + std::clamp(wrapAngle(steering.heading - heading), -step, step), 0, 0};
	rampSurge(steering.surge, dt);
}

TGuidanceCommand CStepGuidance::update(const TControlState& navigation, const Vector2d& current, double dt)
{
	m_depth_target = m_depth.target(m_step, navigation);
	m_command.depth =
		m_depth_reference.update(m_depth_target, m_step.vertical_speed, m_options.dive_acceleration, dt);
	if (m_step.isLeg()) {
		m_command.heading = m_leg.update(navigation, current, dt);
		rampSurge(m_leg.surge(), dt);
	}
	else
		keepStation(navigation, current, dt);
	return m_command;
}

bool CStepGuidance::reached(const TControlState& navigation) const
{
	const bool deep_enough = std::abs(m_depth_target - navigation.depth()) < m_step.tolerance_z;
	switch (m_step.kind) {
		case EStepKind::HOLD:
			return navigation.stamp - m_begun >= m_step.duration;
		case EStepKind::SURFACE:
			return navigation.afloat();
		case EStepKind::DIVE:
			return deep_enough;
		default:
			return deep_enough && (m_end - navigation.horizontal()).norm() < m_step.tolerance_xy;
	}
}

TLegProgress CStepGuidance::progress() const
{
	return m_step.isLeg() ? m_leg.progress() : TLegProgress{ELegPhase::NONE, m_end, m_end, 0, 0};
}
}  // namespace posidonia
