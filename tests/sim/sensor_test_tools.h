#pragma once

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <posidonia/sim/sensor_models.h>

namespace posidonia::testing
{
inline constexpr double kFloor = 6;
inline constexpr double kTiny = 1e-12;

inline const CObservationDVL& asDvl(const mrpt::obs::CObservation::Ptr& o)
{
	return dynamic_cast<CObservationDVL&>(*o);
}
inline TImuReading readingOf(const mrpt::obs::CObservation::Ptr& o)
{
	return imuReadingOf(dynamic_cast<mrpt::obs::CObservationIMU&>(*o)).value();
}
inline Eigen::Vector3d velocityOf(const CObservationDVL& dvl)
{
	return {dvl.velocity.x, dvl.velocity.y, dvl.velocity.z};
}

inline TMotionOptions lively()
{
	TMotionOptions o;
	o.roll = 0.2, o.pitch = 0.15, o.yaw = 0.1, o.heave = 0.2, o.sway = 0.1;
	return o;
}
inline const CVehicleMotion& livelyMotion()
{
	static const CVehicleMotion motion(TRouteOptions(), lively(), 5);
	return motion;
}

inline TImuSpec quietImu()
{
	TImuSpec s = TSensorSuite::sparus2().imu.at("IMU");
	s.gyro_noise_density = s.gyro_random_walk = s.accel_noise_density = s.accel_random_walk = 0;
	return s;
}
inline TDvlSpec quietDvl()
{
	TDvlSpec s = TSensorSuite::sparus2().dvl.at("DVL");
	s.sigma_velocity = 0;
	return s;
}
inline TSimulatedDvlOptions quietRanges()
{
	TSimulatedDvlOptions o;
	o.sigma_altitude = 0;
	return o;
}
inline std::shared_ptr<const CSeaFloor> flatFloor()
{
	return std::make_shared<CFlatSeaFloor>(kFloor);
}
inline CSimulatedDvl makeQuietDvl(const TCalibrationErrorOptions& errors = {})
{
	return {"DVL", quietDvl(), quietRanges(), errors, flatFloor(), 1};
}

/** Mean and standard deviation. */
struct TMoments
{
	double mean{0}, sigma{0};
};
inline TMoments momentsOf(const std::vector<double>& x)
{
	TMoments m;
	for (double v : x)
		m.mean += v / static_cast<double>(x.size());
	for (double v : x)
		m.sigma += (v - m.mean) * (v - m.mean) / static_cast<double>(x.size() - 1);
	m.sigma = std::sqrt(m.sigma);
	return m;
}
/** Within 4.5 standard errors of zero mean and of `sigma`? */
inline void expectWhite(const std::vector<double>& x, double sigma, const std::string& what)
{
	const double n = static_cast<double>(x.size());
	const TMoments m = momentsOf(x);
	EXPECT_LT(std::abs(m.mean), 4.5 * sigma / std::sqrt(n)) << what;
	EXPECT_NEAR(m.sigma, sigma, 4.5 * sigma / std::sqrt(2 * n)) << what;
}

/** sum x y / sqrt(sum x x sum y y), of numbers whose mean is zero by their law. */
inline double correlationOf(const std::vector<double>& x, const std::vector<double>& y)
{
	double xy = 0, xx = 0, yy = 0;
	for (size_t i = 0; i < x.size(); i++)
		xy += x[i] * y[i], xx += x[i] * x[i], yy += y[i] * y[i];
	return xy / std::sqrt(xx * yy);
}
/** Within 4.5 standard errors of `correlation`? */
inline void expectCorrelation(
	const std::vector<double>& x, const std::vector<double>& y, double correlation, const std::string& what)
{
	const double error = (1 - correlation * correlation) / std::sqrt(static_cast<double>(x.size()));
	EXPECT_NEAR(correlationOf(x, y), correlation, 4.5 * error) << what;
}
}  // namespace posidonia::testing
