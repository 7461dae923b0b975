#pragma once

#include <posidonia/base/options.h>

#include <cmath>

namespace posidonia
{
/** Section [Guidance]. */
struct TGuidanceOptions
{
	double look_ahead{1.2}, integral_gain{0.04}, integral_limit{1.5};
	double max_crab{60 * M_PI / 180};
	double acceleration{0.12}, deceleration{0.06};
	double turn_rate{20 * M_PI / 180}, turn_acceleration{0.12}, turn_tolerance{4 * M_PI / 180},
		blend_time{1.5};
	double corner_gain{0.4};
	double station_gain{0.25}, station_speed{0.15}, station_radius{0.06}, station_turn_rate{0.3};
	double dive_acceleration{0.05}, lost_altitude{5};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("look_ahead", look_ahead, above(0), "Look-ahead distance of the line of sight [m]");
		v.number(
			"integral_gain", integral_gain, atLeast(0),
			"Integral gain of the line of sight [m/s]; 0: plain LOS");
		v.number("integral_limit", integral_limit, above(0), "Bound of its integral term [m]");
		v.degrees("max_crab", max_crab, between(0, 85), "Largest crab angle on a leg [deg]");
		v.number("acceleration", acceleration, above(0), "Ramp of the surge, both ways [m/s^2]");
		v.number(
			"deceleration", deceleration, above(0), "Speed allowed at d from the end: sqrt(2 a d) [m/s^2]");
		v.degrees("turn_rate", turn_rate, above(0), "Peak yaw rate of turns on the spot [deg/s]");
		v.number("turn_acceleration", turn_acceleration, above(0), "... and peak of its change [rad/s^2]");
		v.degrees(
			"turn_tolerance", turn_tolerance, above(0), "A turn is over when the heading is this near [deg]");
		v.number(
			"blend_time", blend_time, above(0),
			"The heading goes over from the turn's to the line of sight's with this time constant [s]");
		v.number(
			"corner_gain", corner_gain, atLeast(0),
			"Surge per distance to the corner while turning there [1/s]");
		v.number("station_gain", station_gain, above(0), "Speed per distance when keeping station [1/s]");
		v.number("station_speed", station_speed, above(0), "... and its bound [m/s]");
		v.number(
			"station_radius", station_radius, above(0),
			"Nearer than this the heading is kept, unless a current asks for one [m]");
		v.number("station_turn_rate", station_turn_rate, above(0), "Turn of the heading on station [rad/s]");
		v.number("dive_acceleration", dive_acceleration, above(0), "Of the depth reference [m/s^2]");
		v.number(
			"lost_altitude", lost_altitude, atLeast(0),
			"An altitude is extrapolated by the depth for so long; then the vehicle climbs [s] (COLA2: 5)");
	}
};
}  // namespace posidonia
