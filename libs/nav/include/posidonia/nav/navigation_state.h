#pragma once

#include <posidonia/geometry/se3.h>

/** State of the navigation filter as plain functions; see README for the equations. The filter navigates one
 * point of the body in body axes ("nav" frame): that of the driving IMU, whose accelerometers then need no
 * lever arm, or the body's origin where no accelerometer drives. */
namespace posidonia
{
/** Rows of the error state. The first kMovingSize rows move, the clone's stay. */
enum ENavigationRow : int
{
	kPosition = 0,		   ///< Odom axes [m]
	kAttitude = 3,		   ///< Own frame: R_true = R Exp(e) [rad]
	kVelocity = 6,		   ///< Body axes, times 1 + scale [m/s]
	kGyroBias = 9,		   ///< Body axes [rad/s]
	kAccelBias = 12,	   ///< Body axes [m/s^2]
	kDvlScale = 15,		   ///< Measured / true velocity - 1
	kPressureOffset = 16,  ///< Depth told - true depth [m]
	kAhrsBias = 17,		   ///< About north, east, down: R_measured = Exp(bias) R [rad]
	kGpsBias = 20,		   ///< North, east [m]
	kMovingSize = 22,
	kClonePosition = 22,
	kCloneAttitude = 25,
	kNavigationSize = 28
};
using VectorNav = Eigen::Matrix<double, kNavigationSize, 1>;
using MatrixNav = Eigen::Matrix<double, kNavigationSize, kNavigationSize>;
using MatrixMoving = Eigen::Matrix<double, kMovingSize, kMovingSize>;

/** The nominal state; its errors are the rows above. */
struct TNavigationState
{
	Eigen::Vector3d position{0, 0, 0};	///< Of the navigated point, odom [m]
	Eigen::Matrix3d R_odom_body{Eigen::Matrix3d::Identity()};
	/** Of that point over ground, body axes, times 1 + dvl_scale: as the DVL tells it [m/s]. So the DVL's
	 * equation is linear; were the scale in it, each ping's noise would stand in the scale's derivative and
	 * in the innovation, and their product would drive the scale off (2 % in 5 minutes when tried). */
	Eigen::Vector3d velocity{0, 0, 0};
	Eigen::Vector3d gyro_bias{0, 0, 0};	  ///< Body axes [rad/s]
	Eigen::Vector3d accel_bias{0, 0, 0};  ///< Body axes [m/s^2]
	double dvl_scale{0}, pressure_offset{0};
	Eigen::Vector3d ahrs_bias{0, 0, 0};
	Eigen::Vector2d gps_bias{0, 0};
	Eigen::Vector3d clone_position{0, 0, 0};
	Eigen::Matrix3d R_odom_clone{Eigen::Matrix3d::Identity()};

	/** In metres per second of the world. */
	Eigen::Vector3d trueVelocity() const { return velocity / (1 + dvl_scale); }
	Eigen::Isometry3d T_odom_nav() const;
	Eigen::Isometry3d T_odom_clone() const;
};
TNavigationState retract(const TNavigationState& x, const VectorNav& error);
/** The error with retract(x, error) = y. */
VectorNav localCoordinates(const TNavigationState& x, const TNavigationState& y);

/** T_clone_nav. */
Eigen::Isometry3d displacement(const TNavigationState& x);
/** d (rho, phi) of T_clone_nav / d error, 6 x kNavigationSize. */
Eigen::Matrix<double, 6, kNavigationSize> displacementJacobian(const TNavigationState& x);
}  // namespace posidonia
