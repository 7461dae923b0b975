#include <posidonia/sim/calibration_error.h>
#include <posidonia/sim/random.h>

namespace posidonia
{
using Eigen::Isometry3d;

TCalibrationErrorOptions drawnSigns(const TCalibrationErrorOptions& errors, uint64_t seed)
{
	TCalibrationErrorOptions drawn = errors;
	if (!errors.random_signs) return drawn;
	uint64_t i = 0;
	for (double* e :
		 {&drawn.focal_length, &drawn.baseline, &drawn.camera_yaw, &drawn.camera_pitch, &drawn.camera_roll,
		  &drawn.camera_clock, &drawn.dvl_yaw, &drawn.dvl_pitch, &drawn.dvl_roll, &drawn.dvl_scale})
		if (mixed(seedOf(seed, "calibration error"), i++) & 1) *e = -*e;
	return drawn;
}

namespace
{
/** The sensor turned on the spot about body axes. */
Isometry3d turned(const Isometry3d& T_body_sensor, double yaw, double pitch, double roll)
{
	Isometry3d T = T_body_sensor;
	T.linear() = rotationFromYawPitchRoll(yaw, pitch, roll) * T_body_sensor.linear();
	return T;
}
}  // namespace

TStereoSpec trueStereo(const TStereoSpec& nominal, const TCalibrationErrorOptions& e)
{
	TStereoSpec rig = nominal;
	rig.camera.fx *= 1 + e.focal_length;
	rig.camera.fy *= 1 + e.focal_length;
	rig.camera.baseline *= 1 + e.baseline;
	rig.pose = TSensorMount::poseNumbers(
		turned(nominal.T_body_sensor(), e.camera_yaw, e.camera_pitch, e.camera_roll));
	return rig;
}

Isometry3d trueDvlPose(const TDvlSpec& nominal, const TCalibrationErrorOptions& e)
{
	return turned(nominal.T_body_sensor(), e.dvl_yaw, e.dvl_pitch, e.dvl_roll);
}
}  // namespace posidonia
