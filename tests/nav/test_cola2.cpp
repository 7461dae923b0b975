// [Ekf] mode = cola2: the paper's filter, on our iteration and on MRPT's.
#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/nav/cola2_odometry.h>

#include "nav_simulator.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector3d;
using mrpt::obs::CObservation;

namespace
{
CCola2Odometry odometryFor(const TNavScene& scene, const std::string& iteration = "own")
{
	TEkfOptions options;
	options.mode = "cola2";
	options.cola2_iteration = iteration;
	return {options, knownStart(scene.start), scene.sensors, scene.datum};
}
}  // namespace

TEST(Cola2, BothIterationsGiveTheSame)
{
	TNavScene scene;
	scene.start.translation().z() = 0.5;
	scene.gps_until = 60;
	CCola2Odometry own = odometryFor(scene), stock = odometryFor(scene, "stock");
	double worst_state = 0, worst_covariance = 0;
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth&) {
		own.add(o);
		stock.add(o);
		if (!own.ready()) return;
		worst_state =
			std::max(worst_state, (own.navigationFilter().state() - stock.navigationFilter().state()).norm());
		worst_covariance = std::max(
			worst_covariance,
			(own.navigationFilter().covariance() - stock.navigationFilter().covariance()).norm());
	});
	EXPECT_LT(worst_state, 1e-9);
	EXPECT_LT(worst_covariance, 1e-9);
	EXPECT_GT(own.statistics().sensors.at("GPS").used, 50U);
	EXPECT_GT(own.statistics().sensors.at("DVL").used, 250U);
	EXPECT_EQ(own.statistics().sensors.at("DVL").used, stock.statistics().sensors.at("DVL").used);
}

TEST(Cola2, FollowsTheTruthAndItsEdgesCompose)
{
	TNavScene scene;
	scene.noise = 0;
	CCola2Odometry odometry = odometryFor(scene);
	Eigen::Isometry3d composed = scene.start, truth_at_end;
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
		odometry.add(o);
		truth_at_end = truth.T_map_body;
		if (!dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&o)) return;
		composed = composed * odometry.sinceClone().T;
		odometry.clone();
	});
	EXPECT_LT((odometry.now().T.translation() - truth_at_end.translation()).norm(), 0.2);
	EXPECT_LT((composed.translation() - truth_at_end.translation()).norm(), 0.2);
	EXPECT_NEAR(odometry.now().path_length, 18, 0.2);
}

TEST(Cola2, AnEdgeHasTheCovarianceOfItsErrors)
{
	// Position within the edge: by the filter; attitude: two readings of the AHRS.
	double nees_sum = 0;
	int edges = 0;
	for (unsigned seed = 1; seed <= 10; seed++) {
		TNavScene scene;
		scene.seed = seed;
		scene.acceleration_density = 0.03;
		CCola2Odometry odometry = odometryFor(scene);
		Eigen::Isometry3d T_map_clone = scene.start;
		double next = 2;
		CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
			odometry.add(o);
			const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&o);
			if (!imu || o.sensorLabel != "AHRS" || truth.t < next) return;
			next += 2;
			nees_sum += nees(odometry.sinceClone(), T_map_clone.inverse() * truth.T_map_body) / 6;
			edges++;
			odometry.clone();
			T_map_clone = truth.T_map_body;
		});
	}
	EXPECT_GT(nees_sum / edges, 0.5);
	EXPECT_LT(nees_sum / edges, 2.0);
}

TEST(Cola2, ItThrowsWhereYawAndRollEnd)
{
	CCola2EKF ekf(0.03, 0.999, EIteration::OWN);
	ekf.predict(rotationFromYawPitchRoll(1, 80 * M_PI / 180, 0.2), 0.1);
	try {
		ekf.predict(rotationFromYawPitchRoll(1, 86 * M_PI / 180, 0.2), 0.1);
		FAIL() << "86 degrees were taken";
	}
	catch (const CError& e) {
		EXPECT_NE(std::string(e.what()).find("mode = cola2"), std::string::npos) << e.what();
		EXPECT_NE(std::string(e.what()).find("mode = ins"), std::string::npos) << e.what();
	}
}

TEST(Cola2, WithoutAnAhrsItSaysSo)
{
	TNavScene scene;
	scene.sensors.ahrs.clear();
	EXPECT_THROW(odometryFor(scene), CError);
}
