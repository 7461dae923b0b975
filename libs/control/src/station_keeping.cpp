#include <posidonia/control/station_keeping.h>
#include <posidonia/geometry/se3.h>

#include <algorithm>

namespace posidonia
{
using Eigen::Vector2d;

namespace
{
// The end that leads is changed only beyond this angle: no dithering when the point lies abeam.
constexpr double kChangeEnds = 110 * M_PI / 180;
}  // namespace

double CStationKeeping::bow(const Vector2d& through_water, bool may_reverse, double heading)
{
	const double ahead = std::atan2(through_water.y(), through_water.x());
	if (!may_reverse) m_astern = false;
	const double leading = m_astern ? ahead + M_PI : ahead;
	if (may_reverse && std::abs(wrapAngle(leading - heading)) > kChangeEnds) m_astern = !m_astern;
	return m_astern ? ahead + M_PI : ahead;
}

TSteering CStationKeeping::update(const Vector2d& to_point, const Vector2d& current, double heading)
{
	const double distance = to_point.norm();
	const double speed = std::min(m_options.station_gain * distance, m_options.station_speed);
	const Vector2d wish = distance > 0 ? Vector2d(to_point * (speed / distance)) : Vector2d(0, 0);
	const bool still_water = current.isZero();
	TSteering steering = steer(wish, current, heading);
	steering.heading = still_water && distance < m_options.station_radius
						   ? heading
						   : bow(wish - current, still_water, heading);
	return steering;
}
}  // namespace posidonia
