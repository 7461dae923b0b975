#include <posidonia/control/leg_guidance.h>

#include <algorithm>

namespace posidonia
{
using Eigen::Vector2d;

namespace
{
constexpr double kRateFilter = 0.5;	   // Takes the velocity's noise out of the fed-forward rate [s]
constexpr double kLowestSpeed = 0.05;  // So that the end line is crossed [m/s]
}  // namespace

void CLegGuidance::begin(
	const Vector2d& start, const Vector2d& end, double speed, const TControlState& navigation,
	const Vector2d& current, double heading)
{
	const Vector2d line = end - start;
	m_length = line.norm();
	m_course = m_length > 1e-6 ? std::atan2(line.y(), line.x()) : heading;
	m_speed = speed;
	m_begun = navigation.stamp;
	m_progress = {ELegPhase::TURN, start, end, 0, 0};
	m_los.reset();
	locate(navigation.horizontal());
	m_heading = heading;
	m_blend = m_rate = 0;
	const double bow = m_course + crabbed(m_los.course(m_progress.cross), current);
	m_turn =
		CTurnProfile(heading, wrapAngle(bow - heading), m_options.turn_rate, m_options.turn_acceleration);
}

void CLegGuidance::locate(const Vector2d& position)
{
	const Vector2d from_start = position - m_progress.start;
	const Vector2d along(std::cos(m_course), std::sin(m_course));
	m_progress.along = along.dot(from_start);
	m_progress.cross = along.x() * from_start.y() - along.y() * from_start.x();
}

double CLegGuidance::speed() const
{
	const double left = std::max(0.0, m_length - m_progress.along);
	return std::max(kLowestSpeed, std::min(m_speed, std::sqrt(2 * m_options.deceleration * left)));
}

Vector2d CLegGuidance::along(double course_offset, double speed) const
{
	const double course = m_course + course_offset;
	return speed * Vector2d(std::cos(course), std::sin(course));
}

double CLegGuidance::crabbed(double course_offset, const Vector2d& current) const
{
	const Vector2d wish = along(course_offset, m_speed);
	const double course = m_course + course_offset;
	const double crab = wrapAngle(steer(wish, current, course).heading - course);
	return course_offset + std::clamp(crab, -m_options.max_crab, m_options.max_crab);
}

double CLegGuidance::rateWeight(double now) const
{
	const double slowing = speed() / m_speed;
	return (1 - std::exp(-(now - m_running_since) / m_options.blend_time)) * slowing * slowing;
}

double CLegGuidance::crossRate(const TControlState& navigation) const
{
	const Eigen::Vector3d v_map = navigation.T_map_body.linear() * navigation.v_body;
	return std::cos(m_course) * v_map.y() - std::sin(m_course) * v_map.x();
}

TReference CLegGuidance::update(const TControlState& navigation, const Vector2d& current, double dt)
{
	locate(navigation.horizontal());
	const double turned = navigation.stamp - m_begun;
	const double error = wrapAngle(m_heading - navigation.heading());
	if (m_progress.phase == ELegPhase::TURN && turned >= m_turn.duration() &&
		std::abs(error) < m_options.turn_tolerance)
	{
		m_progress.phase = ELegPhase::RUN;
		m_running_since = navigation.stamp;
		m_blend = wrapAngle(m_heading - m_course - crabbed(m_los.course(m_progress.cross), current));
	}
	if (m_progress.phase == ELegPhase::RUN && m_progress.along >= m_length)
		m_progress.phase = ELegPhase::APPROACH;
	switch (m_progress.phase) {
		case ELegPhase::TURN:
			return turn(navigation);
		case ELegPhase::RUN:
			return run(navigation, current, dt);
		default:
			return approach(navigation, current, dt);
	}
}

TReference CLegGuidance::turn(const TControlState& navigation)
{
	// While it turns, the vehicle comes back to the corner as far as surge can bring it.
	const Vector2d to_corner = m_progress.start - navigation.horizontal();
	const double bow = navigation.heading();
	const double left = to_corner.dot(Vector2d(std::cos(bow), std::sin(bow)));
	const double brakable = std::sqrt(2 * m_options.deceleration * std::abs(left));
	const double fastest = std::min(brakable, m_options.station_speed);
	m_surge = std::clamp(m_options.corner_gain * left, -fastest, fastest);
	const TReference heading = m_turn.at(navigation.stamp - m_begun);
	m_heading = heading.value;
	return heading;
}

TReference CLegGuidance::run(const TControlState& navigation, const Vector2d& current, double dt)
{
	m_blend *= std::exp(-dt / m_options.blend_time);
	const double offset = m_los.update(m_progress.cross, dt);
	m_heading += wrapAngle(m_course + crabbed(offset, current) + m_blend - m_heading);
	const double error = wrapAngle(m_heading - navigation.heading());
	m_surge = steer(along(offset, speed()), current, navigation.heading()).surge * alignment(error);
	const double rate = m_los.courseRate(m_progress.cross, crossRate(navigation));
	m_rate += std::min(1.0, dt / kRateFilter) * (rate - m_rate);
	return {m_heading, m_rate * rateWeight(navigation.stamp), 0};
}

TReference CLegGuidance::approach(const TControlState& navigation, const Vector2d& current, double dt)
{
	const TSteering steering =
		m_station.update(m_progress.end - navigation.horizontal(), current, navigation.heading());
	const double step = m_options.station_turn_rate * dt;
	m_heading += std::clamp(wrapAngle(steering.heading - m_heading), -step, step);
	m_surge = steering.surge;
	return {m_heading, 0, 0};
}
}  // namespace posidonia
