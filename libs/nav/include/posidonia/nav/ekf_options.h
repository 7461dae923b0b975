#pragma once

#include <posidonia/base/options.h>
#include <cmath>
#include <string>
#include <vector>

namespace posidonia
{
/** Section [Ekf]. */
struct TEkfOptions
{
	std::string mode{"ins"};
	std::string cola2_iteration{"own"};
	/** Body velocity walks at random with this density. COLA2's filter has 0.032 (0.02 (m/s^2)^2 at 20 Hz).
	 */
	double acceleration_density{0.03};
	double turn_density{0.2};
	double sigma_initial_velocity{0.5};	 ///< Each axis [m/s]
	double sigma_initial_gyro_bias{
		0.0087};						   ///< [rad/s], turn-on bias of ADIS16448 in uuv_simulator's IMU set
	double sigma_initial_accel_bias{0.1};  ///< [m/s^2]
	std::string dvl{"auto"};
	double max_dvl_speed{3.0};
	double gate_probability{0.999};
	int give_way_after{10};
	double give_way_time{5.0};	///< [s]
	double imu_time_out{1}, dvl_time_out{2}, pressure_time_out{2};
	double max_stamp_jump{2};
	double history{10}, edge_hold{0.5};	 ///< [s]
	double unary_max_age{1.0};
	double gps_max_depth{1.0};
	bool zero_velocity{false};
	bool use_gps{true};
	bool use_heading{true};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice(
			"mode", mode, {"ins", "gyro", "kinematic", "cola2"},
			"ins: gyro and accelerometers drive; gyro: the velocity walks at random; kinematic: no IMU at "
			"all; "
			"cola2: position and velocity only, attitude of the AHRS (the paper's)");
		v.choice(
			"cola2_iteration", cola2_iteration, {"own", "stock"},
			"mode = cola2: our Kalman iteration or MRPT's, with equal results");
		v.number(
			"acceleration_density", acceleration_density, above(0),
			"Random walk of the body velocity where no accelerometer drives it [m/s^2/sqrt(Hz)]; COLA2: "
			"0.032");
		v.number(
			"turn_density", turn_density, above(0),
			"Random walk of the attitude where no gyro drives it [rad/s/sqrt(Hz)]");
		v.number(
			"sigma_initial_velocity", sigma_initial_velocity, above(0),
			"At the start, around zero, each axis [m/s]");
		v.degrees(
			"sigma_initial_gyro_bias", sigma_initial_gyro_bias, above(0),
			"At the start, around zero, each axis [deg/s]");
		v.number(
			"sigma_initial_accel_bias", sigma_initial_accel_bias, above(0),
			"At the start, around zero, each axis [m/s^2]");
		v.choice(
			"dvl", dvl, {"auto", "vector", "beams"},
			"vector: pings with a velocity; beams: beam by beam, one is enough; auto: beams where there is "
			"no "
			"vector");
		v.number("max_dvl_speed", max_dvl_speed, above(0), "A DVL axis or beam beyond this is invalid [m/s]");
		v.number(
			"gate_probability", gate_probability, between(0.5, 0.999999),
			"Part of the good measurements that the chi-square gates let pass");
		v.integer(
			"give_way_after", give_way_after, atLeast(0),
			"The filter gives way to a sensor after so many refusals in a row that agree with each other; 0: "
			"never");
		v.number("give_way_time", give_way_time, atLeast(0), "... and that last so long, at least [s]");
		v.number(
			"imu_time_out", imu_time_out, above(0),
			"A longer silence of IMU or AHRS is an outage: attitude and velocity walk at random [s] (COLA2: "
			"1)");
		v.number(
			"dvl_time_out", dvl_time_out, above(0),
			"A longer silence of the DVL is an outage: the drag model bridges it [s] (COLA2: 2)");
		v.number(
			"pressure_time_out", pressure_time_out, above(0), "A longer silence is an outage [s] (COLA2: 2)");
		v.number(
			"max_stamp_jump", max_stamp_jump, above(0),
			"A stamp further ahead than this waits until others agree with it [s]");
		v.number(
			"history", history, atLeast(0),
			"Readings that come late by up to this are put in their place and the filter replayed [s]");
		v.number(
			"edge_hold", edge_hold, atLeast(0),
			"Late readings revise an odometry edge for so long after its end, then it is final [s]");
		v.number("unary_max_age", unary_max_age, atLeast(0), "Oldest absolute reading handed to a node [s]");
		v.number(
			"gps_max_depth", gps_max_depth, anyNumber(),
			"Fixes told from deeper are not believed [m] (COLA2: 1)");
		v.flag(
			"zero_velocity", zero_velocity,
			"Take silence of the IMU, to its white noise, for rest; for vehicles that start on a rack");
		v.flag("use_gps", use_gps, "Fuse GPS fixes");
		v.flag("use_heading", use_heading, "Fuse the heading of the AHRS; false: its roll and pitch only");
	}
};

/** Section [Drag]: the vehicle without bottom lock. SPARUS II: masses with added mass and quadratic damping
 * of published models, linear damping assumed. */
struct TDragOptions
{
	double mass_surge{54.1}, mass_sway{122.4}, mass_heave{121.2};
	double linear_surge{10}, linear_sway{30}, linear_heave{30};
	double quadratic_surge{36.4}, quadratic_sway{96}, quadratic_heave{89};
	double sigma_surge{0.1}, sigma_sway{0.05}, sigma_heave{0.05};
	double correlation_time{30};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("mass_surge", mass_surge, above(0), "With added mass [kg]");
		v.number("mass_sway", mass_sway, above(0), "With added mass [kg]");
		v.number("mass_heave", mass_heave, above(0), "With added mass [kg]");
		v.number("linear_surge", linear_surge, atLeast(0), "Damping [N/(m/s)]");
		v.number("linear_sway", linear_sway, atLeast(0), "Damping [N/(m/s)]");
		v.number("linear_heave", linear_heave, atLeast(0), "Damping [N/(m/s)]");
		v.number("quadratic_surge", quadratic_surge, atLeast(0), "Damping [N/(m/s)^2]");
		v.number("quadratic_sway", quadratic_sway, atLeast(0), "Damping [N/(m/s)^2]");
		v.number("quadratic_heave", quadratic_heave, atLeast(0), "Damping [N/(m/s)^2]");
		v.number(
			"sigma_surge", sigma_surge, above(0), "What the model does not know: thrust and current [m/s]");
		v.number("sigma_sway", sigma_sway, above(0), "... across [m/s]");
		v.number("sigma_heave", sigma_heave, above(0), "... down [m/s]");
		v.number("correlation_time", correlation_time, above(0), "... and how long such an error lasts [s]");
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
