#pragma once

#include <posidonia/control/guidance_command.h>
#include <posidonia/control/guidance_options.h>

namespace posidonia
{
/** Keeps station without a sway thruster. The wished velocity is proportional to the distance. In a current
 * the bow points into it (steer(): at the point, wish = 0, bow along -current) and the surge thrusters
 * balance it; sideways errors are removed by turning the bow a little off the current, as a weather-vane that
 * is steered. Without a current the bow points at the point, or away from it (the vehicle then goes astern),
 * whichever is nearer, and is kept when the point is within station_radius. */
class CStationKeeping
{
   public:
	explicit CStationKeeping(const TGuidanceOptions& options) : m_options(options) {}

	/** `to_point`: from the vehicle to its station, north east [m]. */
	TSteering update(const Eigen::Vector2d& to_point, const Eigen::Vector2d& current, double heading);

   private:
	/** The bow's direction for a wished velocity through the water. */
	double bow(const Eigen::Vector2d& through_water, bool may_reverse, double heading);

	TGuidanceOptions m_options;
	bool m_astern{false};
};
}  // namespace posidonia
