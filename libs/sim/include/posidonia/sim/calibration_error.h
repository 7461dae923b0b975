#pragma once

#include <posidonia/obs/sensor_suite.h>

namespace posidonia
{
/** Section [CalibrationError]: by how much the world's rig differs from what the rawlog says. All zero by
 * default. */
struct TCalibrationErrorOptions
{
	double focal_length{0}, baseline{0};
	double camera_yaw{0}, camera_pitch{0}, camera_roll{0};
	double camera_clock{0};
	double dvl_yaw{0}, dvl_pitch{0}, dvl_roll{0}, dvl_scale{0};
	bool random_signs{false};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("focal_length", focal_length, between(-0.5, 0.5), "True / nominal focal length - 1");
		v.number("baseline", baseline, between(-0.5, 0.5), "True / nominal baseline - 1");
		v.degrees("camera_yaw", camera_yaw, between(-45, 45), "True mounting turned about body down [deg]");
		v.degrees("camera_pitch", camera_pitch, between(-45, 45), "... about body starboard [deg]");
		v.degrees("camera_roll", camera_roll, between(-45, 45), "... about body forward [deg]");
		v.number(
			"camera_clock", camera_clock, between(-10, 10), "A picture shows the pose at stamp + this [s]");
		v.degrees("dvl_yaw", dvl_yaw, between(-45, 45), "True mounting turned about body down [deg]");
		v.degrees("dvl_pitch", dvl_pitch, between(-45, 45), "... about body starboard [deg]");
		v.degrees("dvl_roll", dvl_roll, between(-45, 45), "... about body forward [deg]");
		v.number("dvl_scale", dvl_scale, between(-0.5, 0.5), "Measured / true velocity - 1");
		v.flag("random_signs", random_signs, "Each error's sign by the seed; the size stays");
	}
};

/** The errors with their signs drawn, if `random_signs` asks for it. */
TCalibrationErrorOptions drawnSigns(const TCalibrationErrorOptions& errors, uint64_t seed);

/** The rig as it is in the world. */
TStereoSpec trueStereo(const TStereoSpec& nominal, const TCalibrationErrorOptions& errors);
/** T_body_dvl as it is in the world. */
Eigen::Isometry3d trueDvlPose(const TDvlSpec& nominal, const TCalibrationErrorOptions& errors);
}  // namespace posidonia
