#pragma once

#include <posidonia/nav/ekf_options.h>
#include <posidonia/nav/measurements.h>
#include <posidonia/nav/motion_model.h>
#include <posidonia/obs/geodesy.h>
#include <posidonia/obs/sensor_suite.h>

#include <string>
#include <vector>

namespace posidonia
{
/** What a navigator is built from, put together once: options, sensors by index, levers and noise. */
struct TNavigatorSetup
{
	/** Throws CError when the mode needs a gyro and `sensors` has none. */
	TNavigatorSetup(
		const TEkfOptions& options, const TDragOptions& drag, const TInitialPoseOptions& start,
		const TSensorSuite& sensors, const TWorldOptions& datum);

	/** One sensor: its label and its entry (exactly one pointer is set but for an AHRS in an IMU). */
	struct TSensor
	{
		std::string label;
		const TImuSpec* imu{nullptr};
		const TAhrsSpec* ahrs{nullptr};
		const TDvlSpec* dvl{nullptr};
		const TPressureSpec* pressure{nullptr};
		const TGpsSpec* gps{nullptr};
		Eigen::Vector3d lever{0, 0, 0};	 ///< From the navigated point, body axes [m]
		double time_out{0};				 ///< A longer silence is an outage [s]; 0: none
		TDvlMount dvl_mount;
		Eigen::Matrix<double, 3, 4> dvl_beams;
	};

	TEkfOptions options;
	TDragOptions drag;
	TInitialPoseOptions start;
	TSensorSuite sensors;
	TWorldOptions datum;
	EDrive drive{EDrive::INERTIAL};
	TMotionNoise noise;
	std::vector<TSensor> sensor;	  ///< By index
	int driving_imu{-1};			  ///< Index; -1: none
	double rate_variance{0};		  ///< Of what the gyro says of the present rate, each axis [rad^2/s^2]
	Eigen::Vector3d origin{0, 0, 0};  ///< From the navigated point to the body's origin, body axes [m]

	TNavigatorSetup(const TNavigatorSetup&) = delete;  // the entries point into `sensors`
	TNavigatorSetup& operator=(const TNavigatorSetup&) = delete;

	/** Of rows kDvlScale to kGpsBias + 1, at the start. */
	Eigen::Matrix<double, 7, 1> startVariance() const;
	/** Index of a label, -1 when there is no entry. */
	int indexOf(const std::string& label) const;
	/** T_nav_body: the body's origin seen from the navigated point, equal axes. */
	Eigen::Isometry3d T_nav_body() const;

   private:
	void addSensors();
	void chooseDrive();
	TMotionNoise motionNoise() const;
	template <class SPEC>
	TSensor& add(const std::string& label, const SPEC& spec, double time_out);
};
}  // namespace posidonia
