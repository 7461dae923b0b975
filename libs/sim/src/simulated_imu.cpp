#include <posidonia/obs/frames.h>
#include <posidonia/sim/simulated_imu.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

TImuReading trueImuReading(const TVehicleState& s, const Isometry3d& T_body_sensor)
{
	const Vector3d r = T_body_sensor.translation(), w = s.omega_body;
	const Matrix3d R_sensor_body = T_body_sensor.linear().transpose();
	const Vector3d at_body = s.T_map_body.linear().transpose() * (s.a_map - Vector3d(0, 0, kGravity));
	return {R_sensor_body * w, R_sensor_body * (at_body + s.alpha_body.cross(r) + w.cross(w.cross(r)))};
}

CSimulatedImu::CSimulatedImu(
	const std::string& label, const TImuSpec& spec, const TSimulatedImuOptions& options, uint64_t seed)
	: m_label(label), m_spec(spec), m_noise(seedOf(seed, label))
{
	m_gyro_bias = options.gyro_bias * m_noise.normals<3>();
	m_accel_bias = options.accel_bias * m_noise.normals<3>();
}

mrpt::obs::CObservation::Ptr CSimulatedImu::measure(const TVehicleState& state, double stamp)
{
	if (m_started) walk();
	m_started = true;
	const double white = std::sqrt(m_spec.rate);  // a density to the sigma of one sample
	const Isometry3d T_body_sensor = m_spec.T_body_sensor();
	TImuReading reading = trueImuReading(state, T_body_sensor);
	reading.rate += m_gyro_bias + m_spec.gyro_noise_density * white * m_noise.normals<3>();
	reading.force += m_accel_bias + m_spec.accel_noise_density * white * m_noise.normals<3>();
	return makeImu(m_label, stamp, T_body_sensor, reading);
}

void CSimulatedImu::walk()
{
	const double step = 1 / std::sqrt(m_spec.rate);
	m_gyro_bias += m_spec.gyro_random_walk * step * m_noise.normals<3>();
	m_accel_bias += m_spec.accel_random_walk * step * m_noise.normals<3>();
}
}  // namespace posidonia
