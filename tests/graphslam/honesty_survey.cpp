#include "honesty_survey.h"

#include <posidonia/sim/random.h>

namespace posidonia::testing
{
namespace
{
constexpr double kDegree = M_PI / 180;
constexpr double kDepth = 3.5;	// [m]

void drawStart(THonestySurvey& s, CNoise noise)
{
	const std::vector<double>& start = s.simulation.route.start;
	s.start.sigma_xy = s.start.sigma_z = 0.02;
	s.start.sigma_roll_pitch = 0.1 * kDegree;
	s.start.sigma_heading = 0.5 * kDegree;
	for (size_t axis = 0; axis < 3; axis++)
		s.start.position[axis] = start[axis] + 0.02 * noise.normal();
	s.start.yaw = start[3] * kDegree + s.start.sigma_heading * noise.normal();
	s.start.pitch = s.start.sigma_roll_pitch * noise.normal();
	s.start.roll = s.start.sigma_roll_pitch * noise.normal();
}

void drawSensors(THonestySurvey& s)
{
	TAhrsSpec& ahrs = s.sensors.ahrs.at("AHRS");
	ahrs.sigma_roll_pitch = ahrs.sigma_heading = 1e-4;	// the paper's
	s.ekf.sigma_initial_gyro_bias = s.simulation.imu.gyro_bias;
	s.ekf.sigma_initial_accel_bias = s.simulation.imu.accel_bias;
	s.simulation.dvl.random_scale = true;
	s.simulation.run.gps = false;
}

void chooseFloor(TFloorOptions& floor, unsigned seed, const std::string& photo)
{
	floor.depth = kDepth + 2.5;
	floor.extent_north = floor.extent_east = 14;
	floor.texture = seed % 2 == 1 || photo.empty() ? "rock" : "photo";
	floor.image = photo;
}
}  // namespace

THonestySurvey honestySurvey(unsigned seed, const std::string& photo)
{
	THonestySurvey s;
	s.simulation.run.seed = seed;
	TRouteOptions& route = s.simulation.route;
	route.depth = kDepth;
	route.start = {-2.25, -2.5, kDepth, 90};
	route.way_points = {-2.25, -2.5, -2.25, 2.5,  -0.75, 2.5,  -0.75, -2.5,	 0.75,
						-2.5,  0.75, 2.5,	2.25, 2.5,	 2.25, -2.5,  -2.25, 2.5};
	chooseFloor(s.simulation.floor, seed, photo);
	drawSensors(s);
	drawStart(s, CNoise(seedOf(seed, "start")));
	return s;
}

THonestyRun runHonestySurvey(const THonestySurvey& survey, const TStereoSlamOptions& options)
{
	const CSurveySimulator simulator(survey.simulation, survey.sensors);
	THonestyRun run;
	run.slam = std::make_unique<CStereoSlam>(
		options, survey.sensors,
		std::make_unique<CEkfOdometry>(survey.ekf, survey.start, survey.sensors, survey.simulation.world),
		std::make_unique<CStereoImageLoader>("memory.rawlog"));
	simulator.stream([&](const TSimulatedObservation& o) {
		if (!o.kept) return;
		if (o.frame) simulator.embedPictures(o);
		run.slam->add(o.observation);
		if (run.slam->addedNode()) run.T_map_body.push_back(o.truth.T_map_body);
	});
	return run;
}
}  // namespace posidonia::testing
