#include <posidonia/sim/simulated_ahrs.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

CSimulatedAhrs::CSimulatedAhrs(
	const std::string& label, const TAhrsSpec& spec, const TSimulatedAhrsOptions& options, uint64_t seed)
	: m_label(label),
	  m_spec(spec),
	  m_options(options),
	  m_noise(seedOf(seed, label)),
	  m_wander(
		  {spec.sigma_tilt_bias, spec.sigma_tilt_bias, spec.sigma_heading_bias}, spec.bias_time,
		  1 / spec.rate, seedOf(seed, label + " wander"))
{
}

mrpt::obs::CObservation::Ptr CSimulatedAhrs::measure(const TVehicleState& state, double stamp)
{
	if (m_started) m_wander.advance();
	m_started = true;
	const Vector3d ypr = yawPitchRoll(state.T_map_body.linear()), noise = m_noise.normals<3>();
	const Matrix3d R_map_body = rotationFromYawPitchRoll(
		ypr[0] + m_options.heading_bias + m_spec.sigma_heading * noise[0],
		ypr[1] + m_spec.sigma_roll_pitch * noise[1], ypr[2] + m_spec.sigma_roll_pitch * noise[2]);
	const Isometry3d T_body_sensor = m_spec.T_body_sensor();
	const Matrix3d R_map_sensor = R_map_body * T_body_sensor.linear();
	return makeAhrs(m_label, stamp, T_body_sensor, expSO3(error()) * R_map_sensor);
}
}  // namespace posidonia
