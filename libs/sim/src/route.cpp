#include <posidonia/base/error.h>
#include <posidonia/geometry/se3.h>
#include <posidonia/sim/route.h>

#include <algorithm>

namespace posidonia
{
using Eigen::Vector3d;

CRoutePlan::CRoutePlan(const TRouteOptions& options)
{
	if (options.way_points.empty() || options.way_points.size() % 2 != 0)
		throw CError(
			"[Route] way_points", std::to_string(options.way_points.size()) + " numbers are no list of pairs",
			"write north east [m] of each set point");
	m_end.from = Vector3d(options.start[0], options.start[1], options.start[2]);
	m_end.heading = options.start[3] * M_PI / 180;
	TSegment rest = m_end;
	rest.duration = options.dwell;
	append(rest);
	m_arrivals.push_back({m_end.start, m_end.from});
	for (size_t i = 0; i < options.way_points.size(); i += 2)
		appendLegTo({options.way_points[i], options.way_points[i + 1], options.depth}, options);
}

void CRoutePlan::append(const TSegment& segment)
{
	m_segments.push_back(segment);
	const double length = segment.leg.at(segment.duration).value;
	m_end.start = segment.start + segment.duration;
	m_end.from += length * segment.direction;
	m_end.heading += segment.turn;
	m_length += length;
}

void CRoutePlan::appendTurnTo(double heading, double peak_rate)
{
	TSegment turn = m_end;
	turn.turn = wrapAngle(heading - m_end.heading);
	if (std::abs(turn.turn) < 1e-9) return;
	turn.duration = kMinimumJerkPeak * std::abs(turn.turn) / peak_rate;
	append(turn);
}

void CRoutePlan::appendLegTo(const Vector3d& point, const TRouteOptions& options)
{
	const Vector3d way = point - m_end.from;
	if (way.norm() > 1e-9) {
		// A vertical leg keeps the heading.
		if (way.head<2>().norm() > 1e-6) appendTurnTo(std::atan2(way.y(), way.x()), options.turn_rate);
		TSegment leg = m_end;
		leg.leg = CLegProfile(way.norm(), options.speed, options.acceleration);
		leg.direction = way.normalized();
		leg.duration = leg.leg.duration();
		append(leg);
		m_end.from = point;	 // exactly, whatever the rounding of the sum
	}
	m_arrivals.push_back({m_end.start, point});
}

TPlannedState CRoutePlan::at(double t) const
{
	const auto later = std::upper_bound(
		m_segments.begin(), m_segments.end(), t,
		[](double time, const TSegment& s) { return time < s.start; });
	const TSegment& s =
		t >= m_end.start ? m_end : (later == m_segments.begin() ? m_segments.front() : *std::prev(later));
	const TProfileValue along = s.leg.at(t - s.start);
	const TProfileValue turn = s.duration > 0 ? minimumJerkStep(t - s.start, s.duration) : TProfileValue{};
	TPlannedState state;
	state.position = s.from + along.value * s.direction;
	state.velocity = along.rate * s.direction;
	state.acceleration = along.acceleration * s.direction;
	state.heading = {s.heading + s.turn * turn.value, s.turn * turn.rate, s.turn * turn.acceleration};
	return state;
}
}  // namespace posidonia
