#include <gtest/gtest.h>

#include "nav_simulator.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using mrpt::obs::CObservation;

namespace
{
constexpr double kDegree = M_PI / 180;

/** The filter believes in `believed`, to the sigmas of the known start. */
CEkfOdometry odometryFrom(const TNavScene& scene, const Isometry3d& believed, int give_way_after)
{
	TEkfOptions options;
	options.give_way_after = give_way_after;
	options.sigma_initial_gyro_bias = 1e-4;	 // else the heading itself soon knows how little it knows
	return {options, knownStart(believed), scene.sensors, scene.datum};
}

/** Runs the scene; returns T_true_estimated at the end. */
Isometry3d endErrorOf(const TNavScene& scene, CEkfOdometry& odometry)
{
	TNavTruth last;
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
		odometry.add(o);
		last = truth;
	});
	return last.T_map_body.inverse() * odometry.now().T;
}

/** Runs a scene whose DVL pings from `from` to `to` [s] are spoilt; returns how often the filter gave way. */
size_t timesGivenWayToDvl(double from, double to, const std::function<void(CObservationDVL&, int)>& spoil)
{
	TNavScene scene;
	CEkfOdometry odometry = odometryFrom(scene, scene.start, 10);
	int pings = 0;
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
		const auto* dvl = dynamic_cast<const CObservationDVL*>(&o);
		if (!dvl || truth.t < from || truth.t > to) return odometry.add(o);
		CObservationDVL spoilt = *dvl;
		spoil(spoilt, pings++);
		odometry.add(spoilt);
	});
	return odometry.statistics().sensors.at("DVL").gave_way;
}
}  // namespace

TEST(GiveWay, AWrongKnownHeadingIsGivenUp)
{
	TNavScene scene;
	Isometry3d believed = scene.start;
	believed.linear() = believed.linear() * rotationFromYawPitchRoll(25 * kDegree, 0, 0);
	CEkfOdometry stubborn = odometryFrom(scene, believed, 0), sensible = odometryFrom(scene, believed, 10);
	EXPECT_GT(logSO3(endErrorOf(scene, stubborn).linear()).norm(), 15 * kDegree);
	EXPECT_EQ(stubborn.statistics().sensors.at("AHRS").gave_way, 0U);
	EXPECT_LT(logSO3(endErrorOf(scene, sensible).linear()).norm(), 1 * kDegree);
	EXPECT_EQ(sensible.statistics().sensors.at("AHRS").gave_way, 1U);
	EXPECT_EQ(sensible.statistics().sensors.at("AHRS").gated_in_row, 0U);
}

TEST(GiveWay, FixesThatAgreeMoveAPositionThatIsSureAndWrong)
{
	TNavScene scene;
	scene.start.translation().z() = 0.3;
	scene.gps_until = 60;
	Isometry3d believed = scene.start;
	believed.translation() += Vector3d(40, -30, 0);
	CEkfOdometry stubborn = odometryFrom(scene, believed, 0), sensible = odometryFrom(scene, believed, 10);
	EXPECT_GT(endErrorOf(scene, stubborn).translation().norm(), 40);
	EXPECT_LT(endErrorOf(scene, sensible).translation().norm(), 1.0);
}

TEST(GiveWay, ADvlThatIsRightIsBelievedAgain)
{
	// The filter is at rest by its own account; the vehicle makes 2.5 m/s, far out of the gate.
	TNavScene scene;
	scene.velocity = Vector3d(2.5, 0, 0);
	TEkfOptions options;
	options.sigma_initial_velocity = 0.01;
	CEkfOdometry odometry(options, knownStart(scene.start), scene.sensors, scene.datum);
	endErrorOf(scene, odometry);
	EXPECT_GE(odometry.statistics().sensors.at("DVL").used, 200U);
	EXPECT_LE(odometry.statistics().sensors.at("DVL").gated, 40U);
}

TEST(GiveWay, OutliersThatContradictEachOtherAreNeverBelieved)
{
	const auto scattered = [](CObservationDVL& dvl, int k) { dvl.velocity.x += 0.7 * ((k * 7) % 5 - 2.3); };
	EXPECT_EQ(timesGivenWayToDvl(20, 40, scattered), 0U);
}

TEST(GiveWay, AShortContradictionIsNotBelieved)
{
	const auto offset = [](CObservationDVL& dvl, int) { dvl.velocity.x += 0.8; };
	EXPECT_EQ(timesGivenWayToDvl(20, 23, offset), 0U);	// a shoal of fish
	EXPECT_GE(timesGivenWayToDvl(20, 40, offset), 1U);
}

TEST(GiveWay, TheLongestGapIsThatOfTheReadingsUsed)
{
	TNavScene scene;
	CEkfOdometry odometry = odometryFrom(scene, scene.start, 10);
	CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth& truth) {
		const bool lost = truth.t > 20 && truth.t < 27;
		if (!lost || !dynamic_cast<const CObservationDVL*>(&o)) odometry.add(o);
	});
	EXPECT_NEAR(odometry.statistics().sensors.at("DVL").longest_gap, 7.2, 0.41);  // two pings must agree
	EXPECT_NE(odometry.statistics().text().find("longest gap 7."), std::string::npos)
		<< odometry.statistics().text();
}
