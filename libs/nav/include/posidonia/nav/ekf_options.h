#pragma once

#include <posidonia/base/options.h>
#include <cmath>
#include <vector>

namespace posidonia
{
/** Section [Ekf]. */
struct TEkfOptions
{
	/** Body velocity walks at random with this density. COLA2's filter has 0.032 (0.02 (m/s^2)^2 at 20 Hz).
	 */
	double acceleration_density{0.03};
	double sigma_initial_velocity{0.5};	 ///< Each axis [m/s]
	double sigma_initial_gyro_bias{
		0.0087};  ///< [rad/s], turn-on bias of ADIS16448 in uuv_simulator's IMU set
	double gate_probability{0.999};
	int give_way_after{10};
	double give_way_time{5.0};	///< [s]
	double max_dvl_speed{3.0};
	double unary_max_age{1.0};
	bool use_gps{true};
	bool use_heading{true};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"acceleration_density", acceleration_density, above(0),
			"Random walk of the body velocity [m/s^2/sqrt(Hz)]; COLA2's filter: 0.032");
		v.number(
			"sigma_initial_velocity", sigma_initial_velocity, above(0),
			"At the start, around zero, each axis [m/s]");
		v.degrees(
			"sigma_initial_gyro_bias", sigma_initial_gyro_bias, above(0),
			"At the start, around zero, each axis [deg/s]");
		v.number(
			"gate_probability", gate_probability, between(0.5, 0.999999),
			"Part of the good measurements that the chi-square gates let pass");
		v.integer(
			"give_way_after", give_way_after, atLeast(0),
			"The filter gives way to a sensor after so many refusals in a row that agree with each other; 0: "
			"never");
		v.number("give_way_time", give_way_time, atLeast(0), "... and that last so long, at least [s]");
		v.number("max_dvl_speed", max_dvl_speed, above(0), "A DVL axis beyond this counts as invalid [m/s]");
		v.number("unary_max_age", unary_max_age, atLeast(0), "Oldest absolute reading handed to a node [s]");
		v.flag("use_gps", use_gps, "Fuse GPS fixes");
		v.flag("use_heading", use_heading, "Fuse the heading of the AHRS; false: its roll and pitch only");
	}
};

/** Section [InitialPose]. */
struct TInitialPoseOptions
{
	bool known{true};
	std::vector<double> position{0, 0, 0};										 ///< North, east, down [m]
	double yaw{0}, pitch{0}, roll{0};											 ///< [rad]
	double sigma_xy{0.05}, sigma_z{0.05};										 ///< [m]
	double sigma_roll_pitch{0.5 * M_PI / 180}, sigma_heading{1.0 * M_PI / 180};	 ///< [rad]
	int gps_fixes{10};
	double gps_max_gap{10};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.flag("known", known, "true: start at the pose below; false: from GPS, AHRS and pressure");
		v.number("x", position[0], anyNumber(), "North [m]");
		v.number("y", position[1], anyNumber(), "East [m]");
		v.number("z", position[2], anyNumber(), "Down [m]");
		v.degrees("yaw", yaw, between(-360, 360), "Heading [deg]");
		v.degrees("pitch", pitch, between(-90, 90), "[deg]");
		v.degrees("roll", roll, between(-180, 180), "[deg]");
		v.number("sigma_xy", sigma_xy, above(0), "Of the known pose, north and east [m]");
		v.number("sigma_z", sigma_z, above(0), "Of the known pose, down [m]");
		v.degrees("sigma_roll_pitch", sigma_roll_pitch, above(0), "Of the known pose [deg]");
		v.degrees("sigma_heading", sigma_heading, above(0), "Of the known pose [deg]");
		v.integer(
			"gps_fixes", gps_fixes, atLeast(1), "Fixes averaged when the pose is not known (COLA2: 10)");
		v.number(
			"gps_max_gap", gps_max_gap, above(0),
			"A longer gap between fixes starts the count anew [s] (COLA2: 10)");
	}
};
}  // namespace posidonia
