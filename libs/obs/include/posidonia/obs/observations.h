#pragma once

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/obs/sensor_suite.h>

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace posidonia
{
/** UTC seconds of an observation's stamp (100 ns ticks). */
double stampOf(const mrpt::obs::CObservation& observation);
/** The stamp of UTC seconds. */
mrpt::system::TTimeStamp stampFrom(double utc_seconds);

/** Angular rate [rad/s] and specific force [m/s^2] of an IMU in its own frame. */
struct TImuReading
{
	Eigen::Vector3d rate, force;
};
/** Empty where the observation carries no rates and forces (an AHRS only). */
std::optional<TImuReading> imuReadingOf(const mrpt::obs::CObservationIMU& imu);
/** Attitude of the sensor in map axes (quaternion if present, else yaw, pitch, roll); empty where there is
 * none. */
std::optional<Eigen::Matrix3d> attitudeOf(const mrpt::obs::CObservationIMU& ahrs);

mrpt::obs::CObservationIMU::Ptr makeImu(
	const std::string& label, double stamp, const Eigen::Isometry3d& T_body_sensor,
	const TImuReading& reading);
mrpt::obs::CObservationIMU::Ptr makeAhrs(
	const std::string& label, double stamp, const Eigen::Isometry3d& T_body_sensor,
	const Eigen::Matrix3d& R_map_sensor);
/** A stereo observation whose pictures are the files `left_name` and `right_name` of the images folder. */
mrpt::obs::CObservationStereoImages::Ptr makeStereo(
	const std::string& label, double stamp, const TStereoSpec& spec, const std::string& left_name,
	const std::string& right_name);
/** Camera and T_body_camera as the observation itself states them. Throws CError when it is not rectified. */
TStereoSpec stereoSpecOf(const mrpt::obs::CObservationStereoImages& pair);

/** Left and right grey pictures. */
struct TGreyPair
{
	cv::Mat left, right;
};
/** Finds and reads the pictures of stereo observations: external files below <rawlog>_Images/, or embedded
 * ones. */
class CStereoImageLoader
{
   public:
	explicit CStereoImageLoader(const std::string& rawlog_path);
	/** Reads both pictures, grey; nothing is kept. Throws CError naming rawlog, stamp, file and folder.
	 * Thread-safe. */
	TGreyPair load(const mrpt::obs::CObservationStereoImages& pair) const;
	const std::string& folder() const { return m_folder; }

   private:
	cv::Mat loadOne(const mrpt::img::CImage& image, const std::string& side, double stamp) const;
	std::string m_rawlog, m_folder;
};

/** <name>_Images beside <name>.rawlog. */
std::string imagesFolderOf(const std::string& rawlog_path);
}  // namespace posidonia
