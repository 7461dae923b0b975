#include <posidonia/nav/measurements.h>

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
CMeasurement::Value padded(const Vector3d& v)
{
	return {v.x(), v.y(), v.z(), 0};
}
CMeasurement::Noise padded(const Matrix3d& cov)
{
	CMeasurement::Noise R = CMeasurement::Noise::Identity();
	R.topLeftCorner<3, 3>() = cov;
	return R;
}
/** The attitude as the AHRS sees it. */
Matrix3d seen(const TNavigationState& x)
{
	return expSO3(x.ahrs_bias) * x.R_odom_body;
}
/** Left Jacobian: Exp(b + d) = Exp(Jl d) Exp(b). */
Matrix3d leftJacobian(const Vector3d& b)
{
	return rightJacobianSO3(-b);
}
}  // namespace

Matrix3d attitudeNoise(const Matrix3d& R_map_body, double sigma_roll_pitch, double sigma_heading)
{
	const Vector3d variance(
		sigma_roll_pitch * sigma_roll_pitch, sigma_roll_pitch * sigma_roll_pitch,
		sigma_heading * sigma_heading);
	return R_map_body.transpose() * variance.asDiagonal() * R_map_body;
}

CAttitudeMeasurement::CAttitudeMeasurement(
	const Matrix3d& R_map_body, double sigma_roll_pitch, double sigma_heading)
	: CMeasurement(Value::Zero(), padded(attitudeNoise(R_map_body, sigma_roll_pitch, sigma_heading))),
	  m_R_map_body(R_map_body)
{
}

CMeasurement::Value CAttitudeMeasurement::predicted(const TNavigationState& x) const
{
	return padded(logSO3(m_R_map_body.transpose() * seen(x)));
}

CMeasurement::Jacobian CAttitudeMeasurement::jacobian(const TNavigationState& x) const
{
	Jacobian H = Jacobian::Zero();
	const Matrix3d J = rightJacobianInverseSO3(predicted(x).head<3>());
	H.block<3, 3>(0, kAttitude) = J;
	H.block<3, 3>(0, kAhrsBias) = J * seen(x).transpose() * leftJacobian(x.ahrs_bias);
	return H;
}

CGravityMeasurement::CGravityMeasurement(const Matrix3d& R_map_body, double sigma_roll_pitch)
	: CMeasurement(
		  padded(Vector3d(R_map_body.row(2).transpose())),
		  padded(Matrix3d(sigma_roll_pitch * sigma_roll_pitch * Matrix3d::Identity())))
{
}

CMeasurement::Value CGravityMeasurement::predicted(const TNavigationState& x) const
{
	return padded(Vector3d(seen(x).row(2).transpose()));
}

CMeasurement::Jacobian CGravityMeasurement::jacobian(const TNavigationState& x) const
{
	Jacobian H = Jacobian::Zero();
	const Matrix3d R = seen(x);
	H.block<3, 3>(0, kAttitude) = skew(R.row(2).transpose());
	H.block<3, 3>(0, kAhrsBias) = R.transpose() * skew(Vector3d::UnitZ()) * leftJacobian(x.ahrs_bias);
	return H;
}
}  // namespace posidonia
