#pragma once

#include <mrpt/obs/CObservation.h>

#include <Eigen/Core>
#include <functional>
#include <string>

namespace posidonia
{
struct TSensorSuite;

/** How an error is added to the readings of one sensor. */
struct TSensorError
{
	/** Numbers that the error has: 3 IMU and DVL, 2 GPS, 1 AHRS and pressure, 0 stereo: it can have none. */
	int dimension{0};
	/** A copy of the observation with an error added, whose first `dimension` numbers count, in the units of
	 * the ini (faults.h). */
	std::function<mrpt::obs::CObservation::Ptr(const mrpt::obs::CObservation&, const Eigen::Vector3d&)> add;
};

/** That of a label. Throws CError that begins with `where` and names the known labels for another. */
TSensorError sensorErrorOf(const TSensorSuite& sensors, const std::string& label, const std::string& where);
}  // namespace posidonia
