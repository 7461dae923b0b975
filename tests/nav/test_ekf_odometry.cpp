#include <gtest/gtest.h>
#include <posidonia/base/error.h>

#include <cstring>

#include "nav_simulator.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using mrpt::obs::CObservation;

namespace
{
TNavScene quietScene()
{
	TNavScene scene;
	scene.noise = 0;
	scene.start.translation() = Vector3d(1, -2, 3);
	scene.start.linear() = rotationFromYawPitchRoll(0.5, 0.02, -0.01);
	return scene;
}
CEkfOdometry odometryFor(const TNavScene& scene, const TEkfOptions& options = {})
{
	return {options, knownStart(scene.start), scene.sensors, scene.datum};
}
bool isStereo(const CObservation& o)
{
	return dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&o);
}
}  // namespace

TEST(EkfOdometry, WithoutNoiseItFollowsTheTruth)
{
	const TNavScene scene = quietScene();
	CEkfOdometry odometry = odometryFor(scene);
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
		odometry.add(o);
		if (!isStereo(o) || truth.t < 1) return;
		EXPECT_DOUBLE_EQ(odometry.stamp(), stampOf(o));
		EXPECT_LT((odometry.now().T.translation() - truth.T_map_body.translation()).norm(), 0.02)
			<< "t=" << truth.t;
		EXPECT_LT((odometry.motion().velocity - truth.velocity).norm(), 2e-3) << "t=" << truth.t;
	});
	EXPECT_NEAR(odometry.now().path_length, 0.3 * 60, 0.1);	 // the first ping waits for the second
}

TEST(EkfOdometry, EdgesComposeToTheTrueWay)
{
	const TNavScene scene = quietScene();
	CEkfOdometry odometry = odometryFor(scene);
	Isometry3d composed = Isometry3d::Identity(), truth_at_start = scene.start, truth_now;
	double path = 0, path_now = 0;
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
		odometry.add(o);
		if (!isStereo(o)) return;
		composed = composed * odometry.sinceClone().T;
		path += odometry.sinceClone().path_length;
		path_now = odometry.now().path_length;
		odometry.clone();
		EXPECT_LT((odometry.sinceClone().T.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
		EXPECT_LT(odometry.sinceClone().cov.norm(), 1e-14);
		EXPECT_EQ(odometry.sinceClone().path_length, 0);
		truth_now = truth.T_map_body;
	});
	const Vector6d e = localCoordinates(truth_at_start.inverse() * truth_now, composed);
	EXPECT_LT(e.head<3>().norm(), 0.06);  // the first half second has no DVL yet
	EXPECT_LT(e.tail<3>().norm(), 2e-3);
	EXPECT_NEAR(path, path_now, 1e-9);
}

TEST(EkfOdometry, SpotTurnMovesTheDvlButNotTheVehicle)
{
	TNavScene scene = quietScene();
	scene.velocity.setZero();
	scene.rate = [](double) { return Vector3d(0, 0, 0.4); };
	CEkfOdometry odometry = odometryFor(scene);
	double fastest = 0;
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth&) {
		if (const auto* dvl = dynamic_cast<const CObservationDVL*>(&o))
			fastest = std::max(fastest, dvl->velocity.norm());
		odometry.add(o);
	});
	EXPECT_NEAR(fastest, 0.4 * 0.4145, 1e-6);  // the instrument itself moves
	EXPECT_LT((odometry.now().T.translation() - scene.start.translation()).norm(), 2e-3);
	EXPECT_LT(odometry.motion().velocity.norm(), 1e-4);
}

TEST(EkfOdometry, PlantedOutliersAreGatedAndCounted)
{
	TNavScene scene;
	scene.start.translation().z() = 0.3;
	scene.gps_until = 60;
	CEkfOdometry odometry = odometryFor(scene);
	int dvl_pings = 0, dvl_planted = 0, fixes = 0, fixes_planted = 0;
	TNavTruth last;
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
		last = truth;
		const auto* dvl = dynamic_cast<const CObservationDVL*>(&o);
		const auto* gps = dynamic_cast<const mrpt::obs::CObservationGPS*>(&o);
		if (dvl && ++dvl_pings % 10 == 0) {
			CObservationDVL wrong = *dvl;
			wrong.velocity.x += 0.8;
			odometry.add(wrong);
			dvl_planted++;
		}
		else if (gps && ++fixes % 7 == 0) {
			mrpt::obs::CObservationGPS wrong = *gps;
			wrong.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields.latitude_degrees +=
				1e-3;  // 111 m
			odometry.add(wrong);
			fixes_planted++;
		}
		else
			odometry.add(o);
	});
	const auto& sensors = odometry.statistics().sensors;
	EXPECT_GE(sensors.at("DVL").gated, size_t(dvl_planted));
	EXPECT_LE(sensors.at("DVL").gated, size_t(dvl_planted + 5));  // 0.1 % of the good ones may go too
	EXPECT_GE(sensors.at("GPS").gated, size_t(fixes_planted));
	EXPECT_LE(sensors.at("GPS").gated, size_t(fixes_planted + 1));
	EXPECT_EQ(sensors.at("DVL").used + sensors.at("DVL").gated, size_t(dvl_pings));
	EXPECT_LT((odometry.now().T.translation() - last.T_map_body.translation()).norm(), 0.3);
	EXPECT_NE(odometry.statistics().text().find("DVL: used"), std::string::npos);
}

TEST(EkfOdometry, InvalidReadingsAndDuplicatesAreDroppedAndCounted)
{
	const TNavScene scene = quietScene();
	CEkfOdometry odometry = odometryFor(scene);
	CEkfOdometry clean = odometryFor(scene);
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
		odometry.add(o);
		clean.add(o);
		const auto* dvl = dynamic_cast<const CObservationDVL*>(&o);
		if (!dvl || truth.t < 1) return;
		CObservationDVL bad = *dvl;
		odometry.add(bad);
		bad.velocity_valid = false;
		odometry.add(bad);
		bad.velocity_valid = true;
		bad.velocity.y = std::nan("");
		odometry.add(bad);
		bad.velocity.y = 9;
		odometry.add(bad);
	});
	const TSensorCount dvl = odometry.statistics().sensors.at("DVL");
	EXPECT_EQ(dvl.duplicate, 295u);
	EXPECT_EQ(dvl.invalid, 3 * 295u);
	EXPECT_EQ(dvl.used, clean.statistics().sensors.at("DVL").used);
	EXPECT_EQ(odometry.now().T.matrix(), clean.now().T.matrix());
}

TEST(EkfOdometry, UnknownLabelIsAnErrorThatNamesIt)
{
	TNavScene scene = quietScene();
	CEkfOdometry odometry = odometryFor(scene);
	CObservationDVL dvl;
	dvl.sensorLabel = "DVL_TAIL";
	dvl.timestamp = stampFrom(kT0);
	const auto imu = makeImu("GYRO7", kT0, Isometry3d::Identity(), {});
	for (const CObservation* o :
		 {static_cast<const CObservation*>(&dvl), static_cast<const CObservation*>(imu.get())})
		try {
			odometry.add(*o);
			FAIL() << o->sensorLabel << " was taken";
		}
		catch (const CError& e) {
			EXPECT_NE(std::string(e.what()).find(o->sensorLabel), std::string::npos) << e.what();
		}
	scene.sensors.imu.clear();
	EXPECT_THROW(odometryFor(scene), CError);
	TEkfOptions without_imu;
	without_imu.mode = "kinematic";
	EXPECT_NO_THROW(odometryFor(scene, without_imu));
}

TEST(EkfOdometry, StartsFromGpsAhrsAndPressureWhenThePoseIsNotKnown)
{
	double mean_nees = 0;
	constexpr int kSeeds = 40;
	for (int seed = 1; seed <= kSeeds; seed++) {
		TNavScene scene;
		scene.seed = seed;
		scene.duration = 12;
		scene.gps_until = 100;
		scene.velocity.setZero();
		scene.start.translation() = Vector3d(20, -30, 0.3);
		scene.start.linear() = rotationFromYawPitchRoll(2.2, 0.03, 0.01);
		TInitialPoseOptions start;
		start.known = false;
		CEkfOdometry odometry({}, start, scene.sensors, scene.datum);
		int fixes = 0;
		bool checked = false;
		CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
			if (dynamic_cast<const mrpt::obs::CObservationGPS*>(&o)) fixes++;
			odometry.add(o);
			// One fix may be refused.
			EXPECT_TRUE(fixes >= 10 || !odometry.ready()) << "seed=" << seed << " t=" << truth.t;
			EXPECT_TRUE(fixes <= 11 || odometry.ready()) << "seed=" << seed << " t=" << truth.t;
			if (!odometry.ready() || checked) return;
			checked = true;
			mean_nees += nees(odometry.now(), truth.T_map_body) / kSeeds;
			EXPECT_LT((odometry.now().T.translation() - truth.T_map_body.translation()).norm(), 1.0)
				<< "seed=" << seed;
		});
		EXPECT_TRUE(checked) << "seed=" << seed;
	}
	EXPECT_GT(mean_nees / 6, 0.5);	// the spread term of the covariance is wide at times
	EXPECT_LT(mean_nees / 6, 1.25);
}

TEST(EkfOdometry, AGapInTheFixesStartsTheCountAnew)
{
	TInitialPoseOptions options;
	options.known = false;
	options.gps_fixes = 3;
	CPoseInitializer initializer(options);
	initializer.addAttitude({Eigen::Matrix3d::Identity(), 0.01, 0.02});
	initializer.addDepth(1.5, 0.1, {0, 0, 0.5});
	initializer.addFix(1, {100, 100}, 0.5, {0, 0, 0});
	initializer.addFix(2, {100, 100}, 0.5, {0, 0, 0});
	for (int i = 0; i < 3; i++) {
		EXPECT_FALSE(initializer.complete()) << "i=" << i;
		initializer.addFix(20 + i, {10, 20}, 0.5, {2, 0, 0});
	}
	ASSERT_TRUE(initializer.complete());
	EXPECT_LT((initializer.pose().T.translation() - Vector3d(8, 20, 1)).norm(), 1e-9);
	EXPECT_NEAR(initializer.pose().cov(0, 0), 0.25 / 3, 1e-9);
}

TEST(EkfOdometry, EdgesDoNotJumpWhereGpsMovesThePose)
{
	TNavScene scene;
	scene.start.translation().z() = 0.3;
	scene.gps_until = 60;
	scene.duration = 30;
	scene.sensors.gps["GPS"].sigma_horizontal = 0.1;
	TInitialPoseOptions start = knownStart(scene.start);
	start.position[0] = 4;	// told 4 m wrong, with a sigma that admits it
	start.sigma_xy = 3;
	CEkfOdometry odometry({}, start, scene.sensors, scene.datum);
	Isometry3d T_map_clone = scene.start;
	double biggest_jump = 0, biggest_edge_error = 0;
	Isometry3d before = Isometry3d::Identity();
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
		if (odometry.ready()) before = odometry.now().T;
		odometry.add(o);
		if (dynamic_cast<const mrpt::obs::CObservationGPS*>(&o))
			biggest_jump =
				std::max(biggest_jump, (odometry.now().T.translation() - before.translation()).norm());
		if (!isStereo(o)) return;
		if (truth.t > 0.5) {
			const Isometry3d true_edge = T_map_clone.inverse() * truth.T_map_body;
			biggest_edge_error = std::max(
				biggest_edge_error, (odometry.sinceClone().T.translation() - true_edge.translation()).norm());
		}
		odometry.clone();
		T_map_clone = truth.T_map_body;
	});
	EXPECT_GT(biggest_jump, 3);
	EXPECT_LT(biggest_edge_error, 0.02);
}

TEST(EkfOdometry, UnaryMeasurementsAreThoseSinceThePreviousNodeAtThePresent)
{
	TNavScene scene = quietScene();
	scene.start.translation().z() = 0.3;
	scene.gps_until = 60;
	scene.duration = 10;
	CEkfOdometry odometry = odometryFor(scene);
	int with_fix = 0;
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
		odometry.add(o);
		if (!isStereo(o)) return;
		if (truth.t < 1) {
			odometry.clone();
			return;
		}
		const TUnaryMeasurements before = odometry.unary();
		odometry.clone();
		const TUnaryMeasurements u = odometry.unary();
		ASSERT_TRUE(u.depth && u.attitude) << "t=" << truth.t;
		EXPECT_NEAR(before.depth->value, u.depth->value, 1e-12)
			<< "clone() must not change what the node gets";
		EXPECT_NEAR(u.depth->value, truth.T_map_body.translation().z(), 2e-3) << "t=" << truth.t;
		EXPECT_NEAR(u.depth->sigma, scene.sensors.pressure.at("PRESSURE").sigmaDepth(), 2e-3);
		EXPECT_LT(logSO3(u.attitude->R_map_body.transpose() * truth.T_map_body.linear()).norm(), 1e-3);
		if (u.position) {
			with_fix++;
			EXPECT_LT((u.position->value - truth.T_map_body.translation().head<2>()).norm(), 0.01);
		}
	});
	EXPECT_EQ(with_fix, 9);	 // one fix a second, each handed out once
	odometry.clone();		 // no reading since the node: nothing to hand out
	auto stereo = mrpt::obs::CObservationStereoImages::Create();
	stereo->timestamp = stampFrom(odometry.stamp() + 0.01);
	odometry.add(*stereo);
	const TUnaryMeasurements none = odometry.unary();
	EXPECT_FALSE(none.depth || none.attitude || none.position);
}

TEST(EkfOdometry, TheSameObservationsGiveTheSameBytes)
{
	TNavScene scene;
	scene.gps_until = 30;
	CEkfOdometry a = odometryFor(scene), b = odometryFor(scene);
	for (CEkfOdometry* odometry : {&a, &b})
		CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth&) {
			odometry->add(o);
			if (isStereo(o)) odometry->clone();
		});
	const TPoseEstimate x = a.now(), y = b.now();
	EXPECT_EQ(0, std::memcmp(x.T.matrix().data(), y.T.matrix().data(), 16 * sizeof(double)));
	EXPECT_EQ(0, std::memcmp(x.cov.data(), y.cov.data(), 36 * sizeof(double)));
	EXPECT_GT(x.cov.norm(), 0);
}
