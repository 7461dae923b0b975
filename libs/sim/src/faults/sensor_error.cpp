#include "sensor_error.h"

#include <mrpt/obs/CObservationGPS.h>
#include <posidonia/base/error.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/CObservationPressure.h>
#include <posidonia/obs/geodesy.h>
#include <posidonia/obs/observations.h>

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationGPS;
using mrpt::obs::CObservationIMU;

namespace
{
constexpr double kDegree = M_PI / 180;

/** A vector in body axes, told in the sensor's. */
template <class OBSERVATION>
Vector3d inSensorAxes(const OBSERVATION& observation, const Vector3d& in_body)
{
	return fromMrpt(observation.sensorPose).linear().transpose() * in_body;
}

void shiftGyro(CObservationIMU& imu, const Vector3d& degrees_a_second)
{
	const Vector3d error = inSensorAxes(imu, degrees_a_second * kDegree);
	const mrpt::obs::TIMUDataIndex rates[] = {mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ};
	for (int i = 0; i < 3; i++)
		imu.set(rates[i], imu.get(rates[i]) + error[i]);
}

void turnHeading(CObservationIMU& ahrs, const Vector3d& degrees)
{
	const Matrix3d turn = rotationFromYawPitchRoll(degrees[0] * kDegree, 0, 0);
	const auto turned =
		makeAhrs(ahrs.sensorLabel, 0, fromMrpt(ahrs.sensorPose), turn * attitudeOf(ahrs).value());
	turned->timestamp = ahrs.timestamp;
	ahrs = *turned;
}

/** The vector and every beam alike. */
void shiftVelocity(CObservationDVL& dvl, const Eigen::Matrix<double, 3, 4>& beams, const Vector3d& in_body)
{
	const Vector3d error = inSensorAxes(dvl, in_body);
	dvl.velocity += mrpt::math::TVector3D(error.x(), error.y(), error.z());
	for (size_t i = 0; i < dvl.beam_velocities.size(); i++)
		dvl.beam_velocities[i] += beams.col(static_cast<Eigen::Index>(i)).dot(error);
}

void shiftFix(CObservationGPS& gps, const Vector3d& north_east)
{
	auto& fix = gps.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
	const TWorldOptions here{fix.latitude_degrees, fix.longitude_degrees};
	const TGeodetic moved = geodeticFromNed({north_east[0], north_east[1], 0}, here);
	fix.latitude_degrees = moved.latitude;
	fix.longitude_degrees = moved.longitude;
}

/** shift(copy, error) as a TSensorError. */
template <class OBSERVATION, class SHIFT>
TSensorError makeError(int dimension, SHIFT shift)
{
	return {dimension, [shift](const CObservation& observation, const Vector3d& error) {
				const auto copy =
					std::make_shared<OBSERVATION>(dynamic_cast<const OBSERVATION&>(observation));
				shift(*copy, error);
				return CObservation::Ptr(copy);
			}};
}

std::string knownLabels(const TSensorSuite& s)
{
	std::string labels;
	const auto add = [&](const auto& entries) {
		for (const auto& entry : entries)
			labels += " " + entry.first;
	};
	add(s.imu), add(s.ahrs), add(s.dvl), add(s.pressure), add(s.gps), add(s.stereo);
	return labels;
}
}  // namespace

TSensorError sensorErrorOf(const TSensorSuite& s, const std::string& label, const std::string& where)
{
	if (s.imu.count(label)) return makeError<CObservationIMU>(3, shiftGyro);
	if (s.ahrs.count(label)) return makeError<CObservationIMU>(1, turnHeading);
	if (s.pressure.count(label))
		return makeError<CObservationPressure>(
			1, [](CObservationPressure& o, const Vector3d& pascal) { o.pressure += pascal[0]; });
	if (s.gps.count(label)) return makeError<CObservationGPS>(2, shiftFix);
	if (s.stereo.count(label)) return {};
	if (!s.dvl.count(label))
		throw CError(where + " label = " + label, "there is no such sensor", "known are" + knownLabels(s));
	const auto beams = s.dvl.at(label).beams();
	return makeError<CObservationDVL>(
		3, [beams](CObservationDVL& dvl, const Vector3d& in_body) { shiftVelocity(dvl, beams, in_body); });
}
}  // namespace posidonia
