#include "simulated_survey.h"

#include <posidonia/obs/observations.h>

namespace posidonia::testing
{
namespace
{
constexpr double kDegree = M_PI / 180;

std::vector<double> lawnMowerPoints(double length)
{
	constexpr double kLeg = 60, kStep = 5;
	std::vector<double> points;
	double way = 0;
	for (int line = 0; way < length; line++) {
		const double near = line % 2 == 0 ? 0 : kLeg;
		points.insert(points.end(), {kStep * line, near, kStep * line, kLeg - near});
		way += kLeg + kStep;
	}
	return points;
}
}  // namespace

TSurveyScene lawnMower(double duration, double depth, unsigned seed)
{
	TSurveyScene s;
	s.world.run.seed = seed;
	s.world.run.duration = duration;
	s.world.run.stereo = false;
	s.world.route.speed = 0.4;
	s.world.route.depth = depth;
	s.world.route.start = {0, 0, depth, 90};
	s.world.route.way_points = lawnMowerPoints(s.world.route.speed * duration + 60);
	s.world.floor.depth = depth + 5;
	s.sensors.imu.at("IMU").rate = 100;
	s.ekf.sigma_initial_gyro_bias = s.world.imu.gyro_bias;
	s.ekf.sigma_initial_accel_bias = s.world.imu.accel_bias;
	return s;
}

TSurveyScene surfaceHour(double duration, unsigned seed)
{
	TSurveyScene s = lawnMower(duration, 0.6, seed);
	s.start.known = false;
	s.world.route.dwell = 15;  // ten fixes at rest
	s.world.dvl.random_scale = true;
	TAhrsSpec& ahrs = s.sensors.ahrs.at("AHRS");
	ahrs.sigma_tilt_bias = 0.2 * kDegree;
	ahrs.sigma_heading_bias = 1 * kDegree;
	TPressureSpec& pressure = s.sensors.pressure.at("PRESSURE");
	pressure.sigma_offset = 500;
	pressure.offset_walk = 5;
	TGpsSpec& gps = s.sensors.gps.at("GPS");
	gps.sigma_bias = 0.5;
	return s;
}

TSurveyScene deadReckoningHour(double duration, unsigned seed)
{
	TSurveyScene s = lawnMower(duration, 10, seed);
	s.world.run.gps = false;
	s.world.calibration_error.dvl_scale = 0.003;
	s.world.calibration_error.random_signs = true;
	s.start.position = {0, 0, 10};
	s.start.yaw = 90 * kDegree;
	return s;
}

void runSurvey(
	const TSurveyScene& scene,
	const std::function<void(const mrpt::obs::CObservation::Ptr&, const TSurveyTruth&)>& sink)
{
	CSensorBank bank(scene.world, scene.sensors);
	const CVehicleMotion motion(scene.world.route, scene.world.motion, scene.world.run.seed);
	for (double t = bank.nextTime(); t <= scene.world.run.duration; t = bank.nextTime()) {
		const TVehicleState state = motion.at(t);
		if (const auto observation = bank.measure(state)) sink(observation, {state, bank.models()});
	}
}

CEkfOdometry odometryFor(const TSurveyScene& scene)
{
	return {scene.ekf, scene.start, scene.sensors, scene.world.world, scene.drag};
}

TEnd endOf(const TSurveyScene& scene)
{
	CEkfOdometry odometry = odometryFor(scene);
	odometry.withoutEdges();
	TVehicleState last;
	runSurvey(scene, [&](const mrpt::obs::CObservation::Ptr& o, const TSurveyTruth& truth) {
		odometry.add(*o);
		last = truth.vehicle;
	});
	const Eigen::Vector3d error = odometry.now().T.translation() - last.T_map_body.translation();
	return {error.norm(), odometry.now().path_length};
}
}  // namespace posidonia::testing
