#include <posidonia/obs/frames.h>
#include <posidonia/sim/sensor_models.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
Vector3d normal3(CNoise& noise)
{
	const double x = noise.normal(), y = noise.normal(), z = noise.normal();  // in this order
	return {x, y, z};
}
}  // namespace

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
	m_gyro_bias = options.gyro_bias * normal3(m_noise);
	m_accel_bias = options.accel_bias * normal3(m_noise);
}

mrpt::obs::CObservation::Ptr CSimulatedImu::measure(const TVehicleState& state, double stamp)
{
	// Continuous-time densities to one sample: white noise by sqrt(rate), the walk's step by sqrt(1 / rate).
	const double white = std::sqrt(m_spec.rate), step = 1 / white;
	const Isometry3d T_body_sensor = m_spec.T_body_sensor();
	TImuReading reading = trueImuReading(state, T_body_sensor);
	reading.rate += m_gyro_bias + m_spec.gyro_noise_density * white * normal3(m_noise);
	reading.force += m_accel_bias + m_spec.accel_noise_density * white * normal3(m_noise);
	m_gyro_bias += m_spec.gyro_random_walk * step * normal3(m_noise);
	m_accel_bias += m_spec.accel_random_walk * step * normal3(m_noise);
	return makeImu(m_label, stamp, T_body_sensor, reading);
}

CSimulatedAhrs::CSimulatedAhrs(
	const std::string& label, const TAhrsSpec& spec, const TSimulatedAhrsOptions& options, uint64_t seed)
	: m_label(label), m_spec(spec), m_options(options), m_noise(seedOf(seed, label))
{
}

mrpt::obs::CObservation::Ptr CSimulatedAhrs::measure(const TVehicleState& state, double stamp)
{
	const Vector3d ypr = yawPitchRoll(state.T_map_body.linear()), noise = normal3(m_noise);
	const Matrix3d R_map_body = rotationFromYawPitchRoll(
		ypr[0] + m_options.heading_bias + m_spec.sigma_heading * noise[0],
		ypr[1] + m_spec.sigma_roll_pitch * noise[1], ypr[2] + m_spec.sigma_roll_pitch * noise[2]);
	const Isometry3d T_body_sensor = m_spec.T_body_sensor();
	return makeAhrs(m_label, stamp, T_body_sensor, R_map_body * T_body_sensor.linear());
}
}  // namespace posidonia
