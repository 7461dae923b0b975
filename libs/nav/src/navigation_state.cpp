#include <posidonia/nav/navigation_state.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
Isometry3d isometry(const Matrix3d& R, const Vector3d& t)
{
	Isometry3d T = Isometry3d::Identity();
	T.linear() = R;
	T.translation() = t;
	return T;
}
}  // namespace

Isometry3d TNavigationState::T_odom_nav() const
{
	return isometry(R_odom_body, position);
}
Isometry3d TNavigationState::T_odom_clone() const
{
	return isometry(R_odom_clone, clone_position);
}

TNavigationState retract(const TNavigationState& x, const VectorNav& e)
{
	TNavigationState y;
	y.position = x.position + e.segment<3>(kPosition);
	y.R_odom_body = x.R_odom_body * expSO3(e.segment<3>(kAttitude));
	y.velocity = x.velocity + e.segment<3>(kVelocity);
	y.gyro_bias = x.gyro_bias + e.segment<3>(kGyroBias);
	y.accel_bias = x.accel_bias + e.segment<3>(kAccelBias);
	y.dvl_scale = x.dvl_scale + e[kDvlScale];
	y.pressure_offset = x.pressure_offset + e[kPressureOffset];
	y.ahrs_bias = x.ahrs_bias + e.segment<3>(kAhrsBias);
	y.gps_bias = x.gps_bias + e.segment<2>(kGpsBias);
	y.clone_position = x.clone_position + e.segment<3>(kClonePosition);
	y.R_odom_clone = x.R_odom_clone * expSO3(e.segment<3>(kCloneAttitude));
	return y;
}

VectorNav localCoordinates(const TNavigationState& x, const TNavigationState& y)
{
	VectorNav e;
	e << y.position - x.position, logSO3(x.R_odom_body.transpose() * y.R_odom_body), y.velocity - x.velocity,
		y.gyro_bias - x.gyro_bias, y.accel_bias - x.accel_bias, y.dvl_scale - x.dvl_scale,
		y.pressure_offset - x.pressure_offset, y.ahrs_bias - x.ahrs_bias, y.gps_bias - x.gps_bias,
		y.clone_position - x.clone_position, logSO3(x.R_odom_clone.transpose() * y.R_odom_clone);
	return e;
}

Isometry3d displacement(const TNavigationState& x)
{
	const Matrix3d R_clone_odom = x.R_odom_clone.transpose();
	return isometry(R_clone_odom * x.R_odom_body, R_clone_odom * (x.position - x.clone_position));
}

Eigen::Matrix<double, 6, kNavigationSize> displacementJacobian(const TNavigationState& x)
{
	const Isometry3d T = displacement(x);
	const Matrix3d R_body_odom = x.R_odom_body.transpose(), R_body_clone = T.linear().transpose();
	Eigen::Matrix<double, 6, kNavigationSize> J = Eigen::Matrix<double, 6, kNavigationSize>::Zero();
	J.block<3, 3>(0, kPosition) = R_body_odom;
	J.block<3, 3>(0, kClonePosition) = -R_body_odom;
	J.block<3, 3>(0, kCloneAttitude) = R_body_clone * skew(T.translation());
	J.block<3, 3>(3, kAttitude).setIdentity();
	J.block<3, 3>(3, kCloneAttitude) = -R_body_clone;
	return J;
}
}  // namespace posidonia
