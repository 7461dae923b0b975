#pragma once

#include <posidonia/base/options.h>
#include <posidonia/control/mission.h>
#include <posidonia/control/navigation_state.h>

namespace posidonia
{
/** Section [Guidance]. */
struct TGuidanceOptions
{
	double look_ahead{1.2}, integral_gain{0.1}, integral_limit{1.5};
	bool current_feed_forward{true};
	double current_time{4}, max_crab{60 * M_PI / 180};
	double acceleration{0.08}, deceleration{0.05};
	double turn_rate{0.3}, turn_tolerance{4 * M_PI / 180};
	double station_gain{0.25}, station_speed{0.15};
	double dive_speed{0.2}, dive_acceleration{0.05}, lost_altitude{5};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("look_ahead", look_ahead, above(0), "Look-ahead distance of the line of sight [m]");
		v.number(
			"integral_gain", integral_gain, atLeast(0),
			"Integral gain of the line of sight [m/s]; 0: plain LOS");
		v.number("integral_limit", integral_limit, above(0), "Bound of its integral term [m]");
		v.flag(
			"current_feed_forward", current_feed_forward,
			"The observed current gives the crab angle at once; off: the integral alone finds it");
		v.number("current_time", current_time, above(0), "Time constant of the current observer [s]");
		v.degrees("max_crab", max_crab, between(0, 85), "Largest crab angle [deg]");
		v.number("acceleration", acceleration, above(0), "Surge ramp up at the start of a leg [m/s^2]");
		v.number("deceleration", deceleration, above(0), "... and down to its end [m/s^2]");
		v.number("turn_rate", turn_rate, above(0), "Peak yaw rate of turns on the spot [rad/s]");
		v.degrees(
			"turn_tolerance", turn_tolerance, above(0), "A turn is over when the heading is this near [deg]");
		v.number("station_gain", station_gain, above(0), "Speed per distance when keeping station [1/s]");
		v.number("station_speed", station_speed, above(0), "... and its bound [m/s]");
		v.number("dive_speed", dive_speed, above(0), "Fastest change of the depth set-point [m/s]");
		v.number("dive_acceleration", dive_acceleration, above(0), "... and of its rate [m/s^2]");
		v.number(
			"lost_altitude", lost_altitude, atLeast(0),
			"An altitude is extrapolated by the depth for so long; then the vehicle climbs [s] (COLA2: 5)");
	}
};

/** What a leg does now. */
enum class ELegPhase
{
	NONE,	   ///< The step is no leg
	TURN,	   ///< Turns on the spot towards the line
	RUN,	   ///< Along the line
	APPROACH,  ///< The end line was crossed outside the tolerance: straight to the point
};

/** Where the vehicle is on the present leg. */
struct TLegProgress
{
	ELegPhase phase{ELegPhase::NONE};
	Eigen::Vector2d start{0, 0}, end{0, 0};	 ///< North east [m]
	double along{0};						 ///< From the start [m]
	double cross{0};						 ///< Cross-track error, positive to starboard of the line [m]
};
}  // namespace posidonia
