#include <posidonia/nav/measurements.h>

#include <cmath>

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

CDvlMeasurement::CDvlMeasurement(
	const Value& z, const Noise& cov, int rows, const Directions& along_body, const Vector3d& lever,
	const TBodyRate& rate)
	// The rate's own noise reaches the instrument through the lever arm.
	: CMeasurement(
		  z, cov + rate.variance * (along_body * skew(lever)) * (along_body * skew(lever)).transpose()),
	  m_along_body(along_body),
	  m_lever(lever),
	  m_rate(rate.rate),
	  m_rows(rows)
{
}

CDvlMeasurement CDvlMeasurement::axes(
	const Vector3d& velocity, const Matrix3d& cov, const TDvlMount& mount, const TBodyRate& rate)
{
	Value z = Value::Zero();
	z.head<3>() = velocity;
	Noise R = Noise::Identity();
	R.topLeftCorner<3, 3>() = cov;
	Directions along_body = Directions::Zero();
	along_body.topRows<3>() = mount.R_dvl_body;
	return {z, R, 3, along_body, mount.lever, rate};
}

CDvlMeasurement CDvlMeasurement::beams(
	const Eigen::Vector4d& radial, double sigma, const Eigen::Matrix<double, 3, 4>& directions,
	const TDvlMount& mount, const TBodyRate& rate)
{
	Value z = Value::Zero();
	Noise R = Noise::Identity();
	Directions along_body = Directions::Zero();
	int rows = 0;
	for (int i = 0; i < 4; i++) {
		if (std::isnan(radial[i])) continue;
		z[rows] = radial[i];
		R(rows, rows) = sigma * sigma;
		along_body.row(rows++) = directions.col(i).transpose() * mount.R_dvl_body;
	}
	return {z, R, rows, along_body, mount.lever, rate};
}

CMeasurement::Value CDvlMeasurement::predicted(const TNavigationState& x) const
{
	return m_along_body * (x.velocity + (m_rate - x.gyro_bias).cross(m_lever));
}

CMeasurement::Jacobian CDvlMeasurement::jacobian(const TNavigationState&) const
{
	Jacobian H = Jacobian::Zero();
	H.block<4, 3>(0, kVelocity) = m_along_body;
	H.block<4, 3>(0, kGyroBias) = m_along_body * skew(m_lever);
	return H;
}

namespace
{
CMeasurement::Value padded(const Vector3d& v)
{
	return {v.x(), v.y(), v.z(), 0};
}
CMeasurement::Noise velocityNoise(const Vector3d& sigma, const Vector3d& origin, double rate_variance)
{
	CMeasurement::Noise R = CMeasurement::Noise::Identity();
	R.topLeftCorner<3, 3>() = sigma.cwiseAbs2().asDiagonal();
	R.topLeftCorner<3, 3>() += rate_variance * skew(origin) * skew(origin).transpose();
	return R;
}
}  // namespace

CBodyVelocityMeasurement::CBodyVelocityMeasurement(
	const Vector3d& velocity, const Vector3d& sigma, const Vector3d& origin, const TBodyRate& rate)
	: CMeasurement(padded(velocity), velocityNoise(sigma, origin, rate.variance)),
	  m_origin(origin),
	  m_rate(rate.rate)
{
}

CMeasurement::Value CBodyVelocityMeasurement::predicted(const TNavigationState& x) const
{
	return padded(x.velocity + (m_rate - x.gyro_bias).cross(m_origin));
}

CMeasurement::Jacobian CBodyVelocityMeasurement::jacobian(const TNavigationState&) const
{
	Jacobian H = Jacobian::Zero();
	H.block<3, 3>(0, kVelocity).setIdentity();
	H.block<3, 3>(0, kGyroBias) = skew(m_origin);
	return H;
}
}  // namespace posidonia
