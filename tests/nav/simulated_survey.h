#pragma once

#include <posidonia/nav/ekf_odometry.h>
#include <posidonia/sim/sensor_bank.h>

#include <functional>

/** A survey AUV's hour over the simulator's sensors (libs/sim), for the filter's statistics. */
namespace posidonia::testing
{
struct TSurveyScene
{
	TSimulationOptions world;
	TSensorSuite sensors{TSensorSuite::sparus2()};
	TEkfOptions ekf;
	TInitialPoseOptions start;
	TDragOptions drag;
};

/** Lawn-mower at 0.4 m/s of at least `duration` [s]: legs of 60 m, 5 m apart, at `depth` [m]. All sensors but
 * the camera, the IMU at 100 Hz. The sensors' lasting errors are drawn from what sensors.ini says of them. */
TSurveyScene lawnMower(double duration, double depth, unsigned seed);
/** Every lasting error that the filter has a state for, at sizes that matter; GPS all the way; the start by
 * GPS. */
TSurveyScene surfaceHour(double duration, unsigned seed);
/** Below the surface from a known start: DVL scale off by 0.3 %, heading noise of 0.5 degrees, ADIS16448. */
TSurveyScene deadReckoningHour(double duration, unsigned seed);

/** The truth at an observation. */
struct TSurveyTruth
{
	TVehicleState vehicle;
	const TSensorModels& models;
};
/** Calls `sink` for each observation in order of stamps. */
void runSurvey(
	const TSurveyScene& scene,
	const std::function<void(const mrpt::obs::CObservation::Ptr&, const TSurveyTruth&)>& sink);

CEkfOdometry odometryFor(const TSurveyScene& scene);

/** Where dead reckoning ended. */
struct TEnd
{
	double error{0}, way{0};  ///< [m]
	double share() const { return error / way; }
};
TEnd endOf(const TSurveyScene& scene);
}  // namespace posidonia::testing
