#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/observations.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using namespace mrpt::obs;

double stampOf(const CObservation& observation)
{
	return mrpt::Clock::toDouble(observation.timestamp);
}
mrpt::system::TTimeStamp stampFrom(double utc_seconds)
{
	return mrpt::Clock::fromDouble(utc_seconds);
}

namespace
{
template <size_t N>
bool hasAll(const CObservationIMU& imu, const TIMUDataIndex (&indices)[N])
{
	for (auto i : indices)
		if (!imu.has(i)) return false;
	return true;
}
constexpr TIMUDataIndex kRates[] = {IMU_WX, IMU_WY, IMU_WZ};
constexpr TIMUDataIndex kForces[] = {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC};
constexpr TIMUDataIndex kQuaternion[] = {IMU_ORI_QUAT_W, IMU_ORI_QUAT_X, IMU_ORI_QUAT_Y, IMU_ORI_QUAT_Z};
constexpr TIMUDataIndex kYawPitchRoll[] = {IMU_YAW, IMU_PITCH, IMU_ROLL};

CObservationIMU::Ptr makeEmptyImu(const std::string& label, double stamp, const Isometry3d& T_body_sensor)
{
	auto imu = CObservationIMU::Create();
	imu->sensorLabel = label;
	imu->timestamp = stampFrom(stamp);
	imu->sensorPose = toMrpt(T_body_sensor);
	return imu;
}
}  // namespace

std::optional<TImuReading> imuReadingOf(const CObservationIMU& imu)
{
	if (!hasAll(imu, kRates) || !hasAll(imu, kForces)) return {};
	TImuReading reading;
	for (int i = 0; i < 3; i++) {
		reading.rate[i] = imu.get(kRates[i]);
		reading.force[i] = imu.get(kForces[i]);
	}
	return reading;
}

std::optional<Matrix3d> attitudeOf(const CObservationIMU& ahrs)
{
	if (hasAll(ahrs, kQuaternion)) {
		const Eigen::Quaterniond q(
			ahrs.get(IMU_ORI_QUAT_W), ahrs.get(IMU_ORI_QUAT_X), ahrs.get(IMU_ORI_QUAT_Y),
			ahrs.get(IMU_ORI_QUAT_Z));
		if (q.norm() < 1e-6) return {};
		return q.normalized().toRotationMatrix();
	}
	if (!hasAll(ahrs, kYawPitchRoll)) return {};
	return rotationFromYawPitchRoll(ahrs.get(IMU_YAW), ahrs.get(IMU_PITCH), ahrs.get(IMU_ROLL));
}

CObservationIMU::Ptr makeImu(
	const std::string& label, double stamp, const Isometry3d& T_body_sensor, const TImuReading& reading)
{
	auto imu = makeEmptyImu(label, stamp, T_body_sensor);
	for (int i = 0; i < 3; i++) {
		imu->set(kRates[i], reading.rate[i]);
		imu->set(kForces[i], reading.force[i]);
	}
	return imu;
}

CObservationIMU::Ptr makeAhrs(
	const std::string& label, double stamp, const Isometry3d& T_body_sensor, const Matrix3d& R_map_sensor)
{
	auto ahrs = makeEmptyImu(label, stamp, T_body_sensor);
	const Eigen::Quaterniond q(R_map_sensor);
	const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
	const Eigen::Vector3d ypr = yawPitchRoll(R_map_sensor);
	for (int i = 0; i < 4; i++)
		ahrs->set(kQuaternion[i], wxyz[i]);
	for (int i = 0; i < 3; i++)
		ahrs->set(kYawPitchRoll[i], ypr[i]);  // for viewers
	return ahrs;
}
}  // namespace posidonia
