#include <posidonia/nav/measurements.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
/** Variances of the first rows, 1 for the padding. */
Matrix3d padded(double variance, int rows)
{
	Matrix3d R = Matrix3d::Identity();
	R.diagonal().head(rows).setConstant(variance);
	return R;
}

/** The rate's own noise reaches the instrument through the lever arm. */
Matrix3d withRateNoise(const Matrix3d& cov, const Isometry3d& T_body_dvl, const TBodyRate& rate)
{
	const Matrix3d G = T_body_dvl.linear().transpose() * skew(T_body_dvl.translation());
	return cov + rate.variance * G * G.transpose();
}
}  // namespace

CDvlMeasurement::CDvlMeasurement(
	const Vector3d& velocity, const Matrix3d& cov, const Isometry3d& T_body_dvl, const TBodyRate& rate)
	: CMeasurement(velocity, withRateNoise(cov, T_body_dvl, rate)),
	  m_R_dvl_body(T_body_dvl.linear().transpose()),
	  m_lever(T_body_dvl.translation()),
	  m_rate(rate.rate)
{
}

Vector3d CDvlMeasurement::predicted(const TNavigationState& x) const
{
	return m_R_dvl_body * (x.velocity + (m_rate - x.gyro_bias).cross(m_lever));
}

CMeasurement::Jacobian CDvlMeasurement::jacobian(const TNavigationState&) const
{
	Jacobian H = Jacobian::Zero();
	H.block<3, 3>(0, kVelocity) = m_R_dvl_body;
	H.block<3, 3>(0, kGyroBias) = m_R_dvl_body * skew(m_lever);
	return H;
}

CDepthMeasurement::CDepthMeasurement(double depth, double sigma, const Vector3d& lever)
	: CMeasurement(Vector3d(depth, 0, 0), padded(sigma * sigma, 1)), m_lever(lever)
{
}

Vector3d CDepthMeasurement::predicted(const TNavigationState& x) const
{
	return {x.position.z() + x.R_odom_body.row(2).dot(m_lever), 0, 0};
}

CMeasurement::Jacobian CDepthMeasurement::jacobian(const TNavigationState& x) const
{
	Jacobian H = Jacobian::Zero();
	H(0, kPosition + 2) = 1;
	H.block<1, 3>(0, kAttitude) = -x.R_odom_body.row(2) * skew(m_lever);
	return H;
}

CHorizontalMeasurement::CHorizontalMeasurement(
	const Vector2d& north_east, double sigma, const Vector3d& lever)
	: CMeasurement(Vector3d(north_east.x(), north_east.y(), 0), padded(sigma * sigma, 2)), m_lever(lever)
{
}

Vector3d CHorizontalMeasurement::predicted(const TNavigationState& x) const
{
	const Vector3d antenna = x.position + x.R_odom_body * m_lever;
	return {antenna.x(), antenna.y(), 0};
}

CMeasurement::Jacobian CHorizontalMeasurement::jacobian(const TNavigationState& x) const
{
	Jacobian H = Jacobian::Zero();
	H.block<2, 2>(0, kPosition).setIdentity();
	H.block<2, 3>(0, kAttitude) = -x.R_odom_body.topRows<2>() * skew(m_lever);
	return H;
}

Matrix3d attitudeNoise(const Matrix3d& R_map_body, double sigma_roll_pitch, double sigma_heading)
{
	const Vector3d variance(
		sigma_roll_pitch * sigma_roll_pitch, sigma_roll_pitch * sigma_roll_pitch,
		sigma_heading * sigma_heading);
	return R_map_body.transpose() * variance.asDiagonal() * R_map_body;
}

CAttitudeMeasurement::CAttitudeMeasurement(
	const Matrix3d& R_map_body, double sigma_roll_pitch, double sigma_heading)
	: CMeasurement(Vector3d::Zero(), attitudeNoise(R_map_body, sigma_roll_pitch, sigma_heading)),
	  m_R_map_body(R_map_body)
{
}

Vector3d CAttitudeMeasurement::predicted(const TNavigationState& x) const
{
	return logSO3(m_R_map_body.transpose() * x.R_odom_body);
}

CMeasurement::Jacobian CAttitudeMeasurement::jacobian(const TNavigationState& x) const
{
	Jacobian H = Jacobian::Zero();
	H.block<3, 3>(0, kAttitude) = rightJacobianInverseSO3(predicted(x));
	return H;
}

CGravityMeasurement::CGravityMeasurement(const Matrix3d& R_map_body, double sigma_roll_pitch)
	: CMeasurement(R_map_body.row(2).transpose(), padded(sigma_roll_pitch * sigma_roll_pitch, 3))
{
}

Vector3d CGravityMeasurement::predicted(const TNavigationState& x) const
{
	return x.R_odom_body.row(2).transpose();
}

CMeasurement::Jacobian CGravityMeasurement::jacobian(const TNavigationState& x) const
{
	Jacobian H = Jacobian::Zero();
	H.block<3, 3>(0, kAttitude) = skew(predicted(x));
	return H;
}
}  // namespace posidonia
