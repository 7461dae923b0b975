#include <posidonia/dataset/attitude_errors.h>
#include <posidonia/geometry/se3.h>

#include <cmath>

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

CAttitudeErrors::CAttitudeErrors(const TAttitudeErrors& errors) : m_errors(errors), m_generator(errors.seed)
{
}

Vector3d CAttitudeErrors::normal3()
{
	const double x = m_normal(m_generator), y = m_normal(m_generator), z = m_normal(m_generator);
	return {x, y, z};
}

void CAttitudeErrors::advanceBias(double stamp)
{
	const double a = m_started ? std::exp(-(stamp - m_stamp) / m_errors.bias_time) : 0;
	m_unit_bias = a * m_unit_bias + std::sqrt(1 - a * a) * normal3();
	m_stamp = stamp;
	m_started = true;
}

Matrix3d CAttitudeErrors::degraded(double stamp, const Matrix3d& R_map_body)
{
	advanceBias(stamp);
	const Vector3d noise = m_errors.noise * normal3();
	Matrix3d R = R_map_body;
	if (m_errors.noise > 0) {  // not through angles for nothing: they round
		const Vector3d ypr = yawPitchRoll(R_map_body) + noise;
		R = rotationFromYawPitchRoll(ypr[0], ypr[1], ypr[2]);
	}
	return m_errors.bias > 0 ? Matrix3d(expSO3(bias()) * R) : R;
}
}  // namespace posidonia
