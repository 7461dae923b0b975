#pragma once

#include <posidonia/geometry/se3.h>

/** State, motion model and derivatives of the navigation filter as plain functions; see README for the
 * equations. */
namespace posidonia
{
/** Rows of the error state. The first kMovingSize rows move, the clone's stay. */
enum ENavigationRow : int
{
	kPosition = 0,	///< Odom axes [m]
	kAttitude = 3,	///< Own frame: R_true = R Exp(e) [rad]
	kVelocity = 6,	///< Body axes [m/s]
	kGyroBias = 9,	///< Body axes [rad/s]
	kMovingSize = 12,
	kClonePosition = 12,
	kCloneAttitude = 15,
	kNavigationSize = 18
};
using VectorNav = Eigen::Matrix<double, kNavigationSize, 1>;
using MatrixNav = Eigen::Matrix<double, kNavigationSize, kNavigationSize>;
using MatrixMoving = Eigen::Matrix<double, kMovingSize, kMovingSize>;

/** The nominal state; its errors are the rows above. */
struct TNavigationState
{
	Eigen::Vector3d position{0, 0, 0};	///< Of the body's origin, odom [m]
	Eigen::Matrix3d R_odom_body{Eigen::Matrix3d::Identity()};
	Eigen::Vector3d velocity{0, 0, 0};	 ///< Over ground, body axes [m/s]
	Eigen::Vector3d gyro_bias{0, 0, 0};	 ///< Body axes [rad/s]
	Eigen::Vector3d clone_position{0, 0, 0};
	Eigen::Matrix3d R_odom_clone{Eigen::Matrix3d::Identity()};

	Eigen::Isometry3d T_odom_body() const;
	Eigen::Isometry3d T_odom_clone() const;
};
TNavigationState retract(const TNavigationState& x, const VectorNav& error);
/** The error with retract(x, error) = y. */
VectorNav localCoordinates(const TNavigationState& x, const TNavigationState& y);

/** What drives a prediction: the mean body rate as the gyro read it [rad/s], over dt [s]. */
struct TMotionInput
{
	Eigen::Vector3d rate{0, 0, 0};
	double dt{0};
};
/** Densities of what the motion model does not know. */
struct TMotionNoise
{
	double acceleration{0};	 ///< Of the body velocity [m/s^2/sqrt(Hz)]
	double gyro{0};			 ///< [rad/s/sqrt(Hz)]
	double gyro_walk{0};	 ///< Of the gyro's bias [rad/s^2/sqrt(Hz)]
};

/** The state dt later: gyro-driven attitude, constant body velocity and bias, the clone stays. */
TNavigationState propagated(const TNavigationState& x, const TMotionInput& u);
/** d propagated / d error of the moving rows, at x. */
MatrixMoving transitionJacobian(const TNavigationState& x, const TMotionInput& u);
/** Covariance that the step adds to the moving rows. */
MatrixMoving transitionNoise(const TNavigationState& x, const TMotionInput& u, const TMotionNoise& noise);

/** T_clone_body. */
Eigen::Isometry3d displacement(const TNavigationState& x);
/** d (rho, phi) of T_clone_body / d error, 6x18. */
Eigen::Matrix<double, 6, kNavigationSize> displacementJacobian(const TNavigationState& x);
}  // namespace posidonia
