#pragma once

#include <gtest/gtest.h>
#include <posidonia/obs/frames.h>
#include <posidonia/sim/renderer.h>

namespace posidonia::testing
{
inline constexpr double kSeaFloor = 6, kTexel = 0.005;	///< [m]
inline TWaterOptions clearWater()
{
	return {0, 0, 0, "none"};
}
inline TCameraOptions perfectSensor()
{
	TCameraOptions o;
	o.noise = 0, o.vignetting = 0;
	return o;
}
inline TOptics perfectOptics()
{
	return {clearWater(), perfectSensor(), {}, {}};
}

inline Eigen::Isometry3d cameraAt(
	double north, double east, double down, double yaw = 0, double pitch = 0, double roll = 0)
{
	Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
	T.translation() << north, east, down;
	T.linear() = rotationFromYawPitchRoll(yaw, pitch, roll) * downLookingCamera();
	return T;
}

/** 16 m x 16 m of one grey. */
inline CFloorTexture plainTexture(int grey)
{
	return {cv::Mat(3200, 3200, CV_8U, cv::Scalar(grey)), kTexel};
}
/** 14 m x 14 m of stones. */
inline const CFloorTexture& rockTexture()
{
	static const CFloorTexture texture = [] {
		TFloorOptions o;
		o.texture = "rock", o.extent_north = o.extent_east = 14;
		return CFloorTexture(o, 1);
	}();
	return texture;
}
/** The ray of pixel (u, v) in map, of unit length. */
inline Eigen::Vector3d rayOf(const TStereoCamera& c, const Eigen::Isometry3d& T_map_camera, int u, int v)
{
	return T_map_camera.linear() * Eigen::Vector3d((u - c.cx) / c.fx, (v - c.cy) / c.fy, 1).normalized();
}
inline double meanOf(const cv::Mat& picture)
{
	return cv::mean(picture)[0];
}
inline double sigmaOf(const cv::Mat& picture)
{
	cv::Scalar mean, sigma;
	cv::meanStdDev(picture, mean, sigma);
	return sigma[0];
}
}  // namespace posidonia::testing
