#pragma once

#include <posidonia/base/options.h>

#include <vector>

namespace posidonia
{
/** Section [Safety]: limits of the rules (COLA2's safety.yaml, G1/G2) and what the actions do. */
struct TSafetyOptions
{
	double max_depth{20}, depth_margin{2}, min_altitude{1.0};
	std::vector<double> cage;
	double navigation_pause{1}, navigation_timeout{2}, depth_timeout{10}, imu_timeout{10}, dvl_timeout{10},
		good_dvl_timeout{20}, altitude_timeout{60}, position_timeout{30};
	double min_battery{0.15};
	double climb_speed{0.5}, ascent_speed{0.3};
	double settle_time{5};
	double emergency_heave{0.75}, emergency_ramp{30}, drop_weight_after{180};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("max_depth", max_depth, above(0), "Deeper than this the vehicle climbs [m] (COLA2: 20)");
		v.number(
			"depth_margin", depth_margin, above(0), "Deeper than max_depth by this: abort and surface [m]");
		v.number(
			"min_altitude", min_altitude, atLeast(0),
			"Nearer to the floor the vehicle climbs [m] (COLA2: 1)");
		v.numbers(
			"cage", cage, 0, anyNumber(),
			"Virtual cage: min north, min east, max north, max east [m]; outside: abort. Empty: none");
		v.number(
			"navigation_pause", navigation_pause, above(0),
			"No valid navigation for this long: the thrusters stop [s] (COLA2: 1)");
		v.number(
			"navigation_timeout", navigation_timeout, above(0),
			"No valid navigation for this long: emergency [s] (COLA2: 2)");
		v.number(
			"depth_timeout", depth_timeout, above(0), "No depth for this long: emergency [s] (COLA2: 10)");
		v.number(
			"imu_timeout", imu_timeout, above(0), "No IMU for this long: abort and surface [s] (COLA2: 10)");
		v.number(
			"dvl_timeout", dvl_timeout, above(0), "No DVL for this long: abort and surface [s] (COLA2: 10)");
		v.number(
			"good_dvl_timeout", good_dvl_timeout, above(0),
			"No good DVL velocity for this long: abort and surface [s] (COLA2: 20)");
		v.number(
			"altitude_timeout", altitude_timeout, above(0),
			"No altitude for this long: abort and surface [s] (COLA2: 60)");
		v.number(
			"position_timeout", position_timeout, above(0),
			"No GPS for this long at the surface: a warning [s] (COLA2: 30)");
		v.number(
			"min_battery", min_battery, between(0, 1),
			"Less charge: abort and surface; below 1.5 times: a warning");
		v.number("climb_speed", climb_speed, above(0), "Upward speed of the climb [m/s] (COLA2: 0.5)");
		v.number("ascent_speed", ascent_speed, above(0), "Upward speed of abort and surface [m/s]");
		v.number(
			"settle_time", settle_time, atLeast(0),
			"Aborts are warnings until the filter has run this long [s] (COLA2: 5)");
		v.number(
			"emergency_heave", emergency_heave, between(0, 1),
			"Upward set-point of the emergency surfacing (COLA2: 0.75)");
		v.number("emergency_ramp", emergency_ramp, above(0), "... reached after this time [s] (COLA2: 30)");
		v.number(
			"drop_weight_after", drop_weight_after, above(0),
			"Emergency surfacing not at the surface after this time: the weight is dropped [s]");
	}
};
}  // namespace posidonia
