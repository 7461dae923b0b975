#pragma once

#include <posidonia/obs/observations.h>
#include <posidonia/sim/random.h>
#include <posidonia/sim/vehicle_motion.h>

namespace posidonia
{
/** Section [SimulatedImu]. */
struct TSimulatedImuOptions
{
	double gyro_bias{1e-3}, accel_bias{0.02};
	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("gyro_bias", gyro_bias, atLeast(0), "Sigma of the turn-on bias, each axis [rad/s]");
		v.number("accel_bias", accel_bias, atLeast(0), "Sigma of the turn-on bias, each axis [m/s^2]");
	}
};

/** Gyroscope and accelerometer: truth + bias + white noise; the bias has a turn-on value and walks. The
 * spec's densities are the Allan parameters N (angle or velocity random walk) and K (rate random walk). */
class CSimulatedImu
{
   public:
	CSimulatedImu(
		const std::string& label, const TImuSpec& spec, const TSimulatedImuOptions& options, uint64_t seed);
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state, double stamp);

	const Eigen::Vector3d& gyroBias() const { return m_gyro_bias; }	   ///< Sensor axes [rad/s]
	const Eigen::Vector3d& accelBias() const { return m_accel_bias; }  ///< Sensor axes [m/s^2]

   private:
	void walk();

	std::string m_label;
	TImuSpec m_spec;
	CNoise m_noise;
	bool m_started{false};
	Eigen::Vector3d m_gyro_bias, m_accel_bias;
};

/** True angular rate and specific force in the axes of a sensor at T_body_sensor. */
TImuReading trueImuReading(const TVehicleState& state, const Eigen::Isometry3d& T_body_sensor);
}  // namespace posidonia
