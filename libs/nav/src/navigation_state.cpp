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

Isometry3d TNavigationState::T_odom_body() const
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
	y.clone_position = x.clone_position + e.segment<3>(kClonePosition);
	y.R_odom_clone = x.R_odom_clone * expSO3(e.segment<3>(kCloneAttitude));
	return y;
}

VectorNav localCoordinates(const TNavigationState& x, const TNavigationState& y)
{
	VectorNav e;
	e << y.position - x.position, logSO3(x.R_odom_body.transpose() * y.R_odom_body), y.velocity - x.velocity,
		y.gyro_bias - x.gyro_bias, y.clone_position - x.clone_position,
		logSO3(x.R_odom_clone.transpose() * y.R_odom_clone);
	return e;
}

TNavigationState propagated(const TNavigationState& x, const TMotionInput& u)
{
	const Vector3d half_turn = (u.rate - x.gyro_bias) * (u.dt / 2);
	const Matrix3d R_half = expSO3(half_turn);	// the velocity turns with the body: use the attitude half way
	TNavigationState y = x;
	y.position += x.R_odom_body * (R_half * x.velocity) * u.dt;
	y.R_odom_body = x.R_odom_body * R_half * R_half;
	return y;
}

MatrixMoving transitionJacobian(const TNavigationState& x, const TMotionInput& u)
{
	const Vector3d half_turn = (u.rate - x.gyro_bias) * (u.dt / 2);
	const Matrix3d R_half = expSO3(half_turn), R_mid = x.R_odom_body * R_half;
	MatrixMoving F = MatrixMoving::Identity();
	F.block<3, 3>(kPosition, kAttitude) = x.R_odom_body * skew(R_half * x.velocity) * -u.dt;
	F.block<3, 3>(kPosition, kVelocity) = R_mid * u.dt;
	F.block<3, 3>(kPosition, kGyroBias) =
		R_mid * skew(x.velocity) * rightJacobianSO3(half_turn) * (u.dt * u.dt / 2);
	F.block<3, 3>(kAttitude, kAttitude) = (R_half * R_half).transpose();
	F.block<3, 3>(kAttitude, kGyroBias) = rightJacobianSO3(2 * half_turn) * -u.dt;
	return F;
}

MatrixMoving transitionNoise(const TNavigationState& x, const TMotionInput& u, const TMotionNoise& noise)
{
	const double dt = u.dt, q = noise.acceleration * noise.acceleration;
	const Matrix3d I = Matrix3d::Identity();
	MatrixMoving Q = MatrixMoving::Zero();
	Q.block<3, 3>(kPosition, kPosition) = q * dt * dt * dt / 3 * I;
	Q.block<3, 3>(kPosition, kVelocity) = q * dt * dt / 2 * x.R_odom_body;
	Q.block<3, 3>(kVelocity, kPosition) = Q.block<3, 3>(kPosition, kVelocity).transpose();
	Q.block<3, 3>(kVelocity, kVelocity) = q * dt * I;
	Q.block<3, 3>(kAttitude, kAttitude) = noise.gyro * noise.gyro * dt * I;
	Q.block<3, 3>(kGyroBias, kGyroBias) = noise.gyro_walk * noise.gyro_walk * dt * I;
	return Q;
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
