#pragma once

#include <posidonia/nav/navigation_state.h>

/** How the state moves on, with derivatives; see README, "Prediction". */
namespace posidonia
{
/** What drives attitude and velocity. */
enum class EDrive
{
	INERTIAL,  ///< Gyro and accelerometers
	GYRO,	   ///< Gyro; the body velocity walks at random
	KINEMATIC  ///< Nothing is measured: attitude and body velocity walk at random
};

/** What a prediction knows: the means of the IMU's readings (body axes, at the navigated point) over dt [s].
 */
struct TMotionInput
{
	EDrive drive{EDrive::INERTIAL};
	Eigen::Vector3d rate{0, 0, 0};	 ///< As the gyro read it [rad/s]; not used by KINEMATIC
	Eigen::Vector3d force{0, 0, 0};	 ///< Specific force as read [m/s^2]; used by INERTIAL only
	double dt{0};
};

/** Steady state of a first-order Gauss-Markov process. */
struct TGaussMarkov
{
	double sigma{0}, time{1};
};

/** Densities of what the motion model does not know. */
struct TMotionNoise
{
	double acceleration{0};				   ///< Of the body velocity where it walks [m/s^2/sqrt(Hz)]
	double turn{0};						   ///< Of the attitude where it walks [rad/s/sqrt(Hz)]
	double gyro{0}, gyro_walk{0};		   ///< [rad/s/sqrt(Hz)], [rad/s^2/sqrt(Hz)]
	double accel{0}, accel_walk{0};		   ///< [m/s^2/sqrt(Hz)], [m/s^3/sqrt(Hz)]
	double offset_walk{0};				   ///< Of the pressure's offset [m/sqrt(s)]
	TGaussMarkov tilt_bias, heading_bias;  ///< Of the AHRS [rad], [s]
	TGaussMarkov gps_bias;				   ///< Each axis [m], [s]
};

/** The state dt later; the clone stays. */
TNavigationState propagated(const TNavigationState& x, const TMotionInput& u, const TMotionNoise& noise);

/** Rows 0-8 (position, attitude, velocity) of d propagated / d error against the first 15 columns (those
 * three and both biases). The other moving rows keep themselves, times gaussMarkovDecay(). */
inline constexpr int kDriven = 9, kDriving = 16;
using MatrixDriven = Eigen::Matrix<double, kDriven, kDriving>;
MatrixDriven drivenJacobian(const TNavigationState& x, const TMotionInput& u);

/** Factors that the rows from kAhrsBias to the end of kGpsBias keep of themselves over dt. */
Eigen::Matrix<double, 5, 1> gaussMarkovDecay(double dt, const TMotionNoise& noise);

/** Covariance that the step adds to the driven rows (the first 9, a full block) ... */
Eigen::Matrix<double, kDriven, kDriven> drivenNoise(
	const TNavigationState& x, const TMotionInput& u, const MatrixDriven& F, const TMotionNoise& noise);
/** ... and to the other moving rows, a diagonal. */
Eigen::Matrix<double, kMovingSize - kDriven, 1> walkingNoise(double dt, const TMotionNoise& noise);
}  // namespace posidonia
