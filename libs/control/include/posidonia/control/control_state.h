#pragma once

#include <posidonia/geometry/se3.h>

#include <optional>

namespace posidonia
{
/** What the controllers know of the vehicle, whoever says it (filter, SLAM, or the simulator itself).
 * Map is north-east-down, body forward-starboard-down. */
struct TControlState
{
	double stamp{0};  ///< UTC [s]
	Eigen::Isometry3d T_map_body{Eigen::Isometry3d::Identity()};
	Eigen::Vector3d v_body{0, 0, 0};	  ///< Over ground, in body axes [m/s]
	Eigen::Vector3d omega_body{0, 0, 0};  ///< [rad/s]
	std::optional<double> altitude;		  ///< Height over the floor [m], when the DVL has one now
	bool valid{false};					  ///< False: nothing else here may be used
	Matrix6d cov{Matrix6d::Zero()};		  ///< Of T_map_body, as geometry/se3.h defines it

	double north() const { return T_map_body.translation().x(); }
	double east() const { return T_map_body.translation().y(); }
	double depth() const { return T_map_body.translation().z(); }
	Eigen::Vector2d horizontal() const { return T_map_body.translation().head<2>(); }
	/** Heading in (-pi, pi], clockwise from north [rad]. */
	double heading() const { return yawPitchRoll(T_map_body.linear())[0]; }
	/** At the surface: the origin of a vehicle that floats is above 0.3 m. */
	bool afloat() const { return depth() < 0.3; }
	double pitch() const { return yawPitchRoll(T_map_body.linear())[1]; }
};

/** What the safety supervisor watches besides the state. An age is the time since the last value came [s];
 * that of a sensor which the vehicle has not got stays 0. */
struct TVehicleHealth
{
	double stamp{0};		   ///< Now, by the vehicle's clock [s]; goes on when the navigation does not
	double navigation_age{0};  ///< Since the last valid TControlState; 0 before the first [s]
	double imu_age{0};
	double dvl_age{0};		 ///< Since the last DVL message, good or not
	double good_dvl_age{0};	 ///< Since the last DVL velocity that could be used
	double depth_age{0};
	double altitude_age{0};
	double position_age{0};		  ///< Since the last GPS fix
	double initialised_for{1e9};  ///< Since the filter was initialised [s]
	double battery{1};			  ///< Charge, 0 to 1
	double mission_time{0};		  ///< Since the mission's start [s]
};
}  // namespace posidonia
