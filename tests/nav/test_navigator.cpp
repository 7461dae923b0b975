// What the navigator does with single sensors: declination, beams, rest, drag, offsets.
#include <gtest/gtest.h>
#include <posidonia/nav/drag_model.h>
#include <posidonia/obs/observations.h>

#include "nav_simulator.h"
#include "simulated_survey.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector3d;
using mrpt::obs::CObservation;

namespace
{
constexpr double kDegree = M_PI / 180;

/** Runs the survey, each observation through `change`, which may drop it (null). */
CEkfOdometry runChanged(
	const TSurveyScene& scene, const std::function<CObservation::Ptr(CObservation::Ptr, double t)>& change,
	TVehicleState* last = nullptr)
{
	CEkfOdometry odometry = odometryFor(scene);
	runSurvey(scene, [&](const CObservation::Ptr& o, const TSurveyTruth& truth) {
		if (last) *last = truth.vehicle;
		if (const auto changed = change(o, truth.vehicle.t)) odometry.add(*changed);
	});
	return odometry;
}
CObservation::Ptr asItIs(CObservation::Ptr o, double)
{
	return o;
}
}  // namespace

TEST(Navigator, EastDeclinationIsAddedToTheHeading)
{
	// The vehicle heads east (90 degrees true); the compass, 12 degrees off to the east, says 78.
	TNavScene scene;
	scene.duration = 5;
	scene.rate = [](double) { return Vector3d(0, 0, 0); };
	scene.start.linear() = rotationFromYawPitchRoll(90 * kDegree, 0, 0);
	scene.sensors.ahrs.at("AHRS").declination = 12 * kDegree;
	TInitialPoseOptions start = knownStart(scene.start);
	start.yaw = 1.2;  // not known
	start.sigma_heading = 1;
	CEkfOdometry odometry({}, start, scene.sensors, scene.datum);
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth&) {
		if (o.sensorLabel != "AHRS") return odometry.add(o);
		const auto magnetic = makeAhrs(
			"AHRS", stampOf(o), scene.sensors.ahrs.at("AHRS").T_body_sensor(),
			rotationFromYawPitchRoll(78 * kDegree, 0, 0));
		odometry.add(*magnetic);
	});
	EXPECT_NEAR(yawPitchRoll(odometry.now().T.linear())[0], 90 * kDegree, 0.2 * kDegree);
}

TEST(Navigator, TwoBeamsStillHelp)
{
	// After 20 s no ping has more than two beams, or none at all.
	const auto errorWith = [](int beams) {
		double sum = 0;
		for (unsigned seed = 1; seed <= 3; seed++) {
			TVehicleState last;
			const CEkfOdometry odometry = runChanged(
				deadReckoningHour(60, seed),
				[beams](CObservation::Ptr o, double t) -> CObservation::Ptr {
					auto dvl = std::dynamic_pointer_cast<CObservationDVL>(o);
					if (!dvl || t < 20) return o;
					dvl->velocity_valid = false;
					for (size_t i = static_cast<size_t>(beams); i < 4; i++)
						dvl->beam_velocities[i] = std::nan("");
					return dvl;
				},
				&last);
			sum += (odometry.now().T.translation() - last.T_map_body.translation()).norm() / 3;
		}
		return sum;
	};
	const double none = errorWith(0), two = errorWith(2), three = errorWith(3);
	EXPECT_LT(two, 0.5 * none) << "none " << none << " m, two " << two << " m, three " << three << " m";
	EXPECT_LT(three, 0.1) << "none " << none << " m, two " << two << " m";
}

TEST(Navigator, BeamByBeamIsAsGoodAsTheVector)
{
	TSurveyScene scene = deadReckoningHour(60, 4);
	TVehicleState last;
	const CEkfOdometry vector = runChanged(scene, asItIs, &last);
	scene.ekf.dvl = "beams";
	const CEkfOdometry beams = runChanged(scene, asItIs);
	EXPECT_LT((vector.now().T.translation() - beams.now().T.translation()).norm(), 2e-3);
	EXPECT_LT((beams.now().T.translation() - last.T_map_body.translation()).norm(), 0.3);
	EXPECT_EQ(beams.statistics().sensors.at("DVL").used, vector.statistics().sensors.at("DVL").used);
}

TEST(Navigator, BeamsThatContradictEachOtherAreRefused)
{
	int spoilt = 0;
	const CEkfOdometry odometry = runChanged(deadReckoningHour(30, 5), [&](CObservation::Ptr o, double t) {
		auto dvl = std::dynamic_pointer_cast<CObservationDVL>(o);
		if (dvl && t > 10 && t < 15) {
			dvl->beam_velocities[0] += 0.02;  // ten sigmas of one beam; the vector stays as it was
			spoilt++;
		}
		return o;
	});
	EXPECT_GE(spoilt, 24);
	EXPECT_GE(odometry.statistics().sensors.at("DVL").inconsistent, static_cast<size_t>(spoilt));
	EXPECT_LE(odometry.statistics().sensors.at("DVL").inconsistent, static_cast<size_t>(spoilt + 2));
}

TEST(Navigator, AFirstPingThatIsWrongIsNotBelieved)
{
	bool first = true;
	TVehicleState last;
	const CEkfOdometry odometry = runChanged(
		deadReckoningHour(30, 6),
		[&](CObservation::Ptr o, double) {
			auto dvl = std::dynamic_pointer_cast<CObservationDVL>(o);
			if (dvl && std::exchange(first, false)) {
				dvl->velocity.x += 1;  // two sigmas of the start's velocity: no gate would see it
				dvl->beam_velocities.clear();
			}
			return o;
		},
		&last);
	EXPECT_LT((odometry.now().T.translation() - last.T_map_body.translation()).norm(), 0.1);
	EXPECT_EQ(odometry.statistics().sensors.at("DVL").gave_way, 0U);
}

TEST(Navigator, AtRestOnARackTheIMUAloneHolds)
{
	// No DVL, no ripple: a vehicle on deck.
	TSurveyScene scene = deadReckoningHour(60, 7);
	scene.world.motion = {0, 0, 0, 0, 0, 9, 5};
	scene.world.route.way_points = {0, 0};
	scene.world.run.dvl = false;
	const double drift = runChanged(scene, asItIs).now().T.translation().head<2>().norm();
	scene.ekf.zero_velocity = true;
	const CEkfOdometry held = runChanged(scene, asItIs);
	EXPECT_LT(held.now().T.translation().head<2>().norm(), 0.2);
	EXPECT_GT(drift, 1);
	EXPECT_LT(held.motion().velocity.norm(), 0.02);
}

TEST(Navigator, AMovingVehicleIsNotTakenForOneAtRest)
{
	TSurveyScene scene = deadReckoningHour(60, 8);
	const CEkfOdometry without = runChanged(scene, asItIs);
	scene.ekf.zero_velocity = true;
	const CEkfOdometry with = runChanged(scene, asItIs);
	// The survey starts with two seconds of rest.
	EXPECT_LT((with.now().T.translation() - without.now().T.translation()).norm(), 1e-3);
}

TEST(Navigator, FixesFromTheDeepAreNotBelieved)
{
	TSurveyScene scene = deadReckoningHour(20, 9);
	scene.world.run.gps = true;
	scene.world.gps.max_depth = 100;  // a receiver that tells its last fix for ever
	const CEkfOdometry odometry = runChanged(scene, asItIs);
	EXPECT_EQ(odometry.statistics().sensors.at("GPS").used, 0U);
	EXPECT_EQ(odometry.statistics().sensors.at("GPS").invalid, 21U);
}

TEST(Navigator, ThePressureOffsetIsLearnedFromAKnownStart)
{
	TSurveyScene scene = deadReckoningHour(20, 10);
	scene.sensors.pressure.at("PRESSURE").sigma_offset = 3000;	// 0.3 m
	scene.start.sigma_z = 0.01;
	double truth = 0;
	CEkfOdometry odometry = odometryFor(scene);
	runSurvey(scene, [&](const CObservation::Ptr& o, const TSurveyTruth& t) {
		odometry.add(*o);
		const TPressureSpec& spec = scene.sensors.pressure.at("PRESSURE");
		truth = t.models.pressure.at("PRESSURE")->offset() / (spec.water_density * kGravity);
	});
	EXPECT_GT(std::abs(truth), 0.02);
	EXPECT_NEAR(odometry.navigationFilter().state().pressure_offset, truth, 0.03);
	EXPECT_LT(odometry.navigationFilter().covariance()(kPressureOffset, kPressureOffset), 0.02 * 0.02);
}

TEST(DragModel, SurgeKeepsItsSpeedAndSwayFollowsItsEquation)
{
	TDragOptions options;
	options.linear_sway = 0;
	CDragModel model(options);
	model.start({0.5, 0.3, 0});
	for (int i = 0; i < 20; i++)
		model.advance(1);
	EXPECT_NEAR(model.velocity().x(), 0.5, 1e-12);
	// m dv/dt = -d v^2: v = v0 / (1 + v0 d t / m)
	EXPECT_NEAR(
		model.velocity().y(), 0.3 / (1 + 0.3 * options.quadratic_sway * 20 / options.mass_sway), 1e-3);
	EXPECT_EQ(model.velocity().z(), 0);
}

TEST(DragModel, CorrelatedReadingsAreToldAsWeakAsTheirMeanIs)
{
	// n readings of sigma s: s / sqrt(n). An error that lasts tau over n periods: about sigma sqrt(2 tau / (n
	// dt)).
	const CDragModel model({});
	const double dt = 1, tau = TDragOptions().correlation_time, n = 300;
	EXPECT_NEAR(
		model.sigmaOfReading(dt).x() / std::sqrt(n),
		TDragOptions().sigma_surge * std::sqrt(2 * tau / (n * dt)), 1e-12);
}
