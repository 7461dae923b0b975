#pragma once

#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/CObservationPressure.h>
#include <posidonia/obs/observations.h>

#include <limits>

namespace posidonia::testing
{
/** A ping with every field set to something of its own. */
inline CObservationDVL sampleDvl(double stamp)
{
	CObservationDVL dvl;
	dvl.sensorLabel = "DVL";
	dvl.timestamp = stampFrom(stamp);
	dvl.velocity = {0.125, -0.25, 0.0625};
	dvl.velocity_valid = true;
	for (int r = 0; r < 3; r++)
		for (int c = 0; c < 3; c++)
			dvl.velocity_covariance(r, c) = 1 + r * 3 + c;
	dvl.altitude = 2.515625;
	dvl.altitude_valid = true;
	dvl.beam_velocities = {0.1, std::numeric_limits<double>::quiet_NaN(), -0.3, 0.4};
	dvl.beam_ranges = {2.9, 3.0, 3.1, std::numeric_limits<double>::quiet_NaN()};
	dvl.sensorPose = mrpt::poses::CPose3D(-0.4145, 0, 0.11, 2.356, 0.01, -3.1);
	return dvl;
}

inline CObservationPressure samplePressure(double stamp, double pascal = 136789.4375)
{
	CObservationPressure pressure;
	pressure.sensorLabel = "PRESSURE";
	pressure.timestamp = stampFrom(stamp);
	pressure.pressure = pascal;
	pressure.sensorPose = mrpt::poses::CPose3D(0.387, 0, -0.033, 0.1, 0.2, 0.3);
	return pressure;
}
}  // namespace posidonia::testing
