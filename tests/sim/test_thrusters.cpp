#include "vehicle_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector3d;

namespace
{
TThrusterOptions instantSetPoints()
{
	TThrusterOptions o;
	o.slew_rate = 1e9;
	return o;
}
/** d thrust / dt from rest times the time constant: the steady thrust. */
Vector3d steadyThrusts(const TThrusterOptions& o, const Vector3d& set_points, double speed_ahead = 0)
{
	CThrusters thrusters(o);
	thrusters.setSetPoints(0, set_points);
	const Vector3d lag(o.time_constant.data());
	Vector6d nu_r = Vector6d::Zero();
	nu_r[0] = speed_ahead;
	return thrusters.thrustRate(1e3, Vector3d::Zero(), nu_r).cwiseProduct(lag);
}
/** Thrusts after t seconds of a set-point, in a vehicle. */
Vector3d thrustsAfter(double t, const TThrusterOptions& o, const Vector3d& set_points)
{
	CVehicleDynamics vehicle({}, o, {}, kNoFloor, 1, poseAt(50));
	vehicle.setSetPoints(set_points);
	vehicle.advanceTo(t);
	return vehicle.thrusts();
}
}  // namespace

TEST(Thrusters, SteadyThrustGoesWithTheSquareOfTheSetPoint)
{
	EXPECT_LT((steadyThrusts({}, {1, 1, 1}) - Vector3d(71.5, 71.5, 55)).norm(), 1e-9);
	EXPECT_LT((steadyThrusts({}, {-1, -1, -1}) + Vector3d(30, 30, 28.5)).norm(), 1e-9);
	EXPECT_LT((steadyThrusts({}, {0.5, -0.5, 0.2}) - Vector3d(71.5 / 4, -30 / 4.0, 55 * 0.04)).norm(), 1e-9);
}

TEST(Thrusters, SetPointsSaturate)
{
	EXPECT_EQ(steadyThrusts({}, {5, -7, 2}), steadyThrusts({}, {1, -1, 1}));
}

TEST(Thrusters, StandStillInTheDeadBand)
{
	TThrusterOptions o;
	o.dead_band = 0.1;
	EXPECT_EQ(steadyThrusts(o, {0.0999, -0.0999, 0.05}), Vector3d(0, 0, 0));
	EXPECT_NEAR(steadyThrusts(o, {0.1, 0, 0})[0], 0.715, 1e-9);
	EXPECT_NEAR(steadyThrusts(o, {0, -0.1, 0})[1], -0.3, 1e-9);
}

TEST(Thrusters, LagIsOfFirstOrder)
{
	const TThrusterOptions o = instantSetPoints();	// but for one step of the integration: 0.1 %
	for (const double t : {0.4, 0.8, 2.0}) {
		const Vector3d T = thrustsAfter(t, o, {1, -1, 1});
		EXPECT_NEAR(T[0], 71.5 * (1 - std::exp(-t / 0.8)), 0.07) << t;
		EXPECT_NEAR(T[1], -30 * (1 - std::exp(-t / 0.8)), 0.07) << t;
		EXPECT_NEAR(T[2], 55 * (1 - std::exp(-t / 0.4)), 0.07) << t;
	}
}

TEST(Thrusters, SetPointMovesAtItsLargestRate)
{
	CThrusters thrusters({});
	thrusters.setSetPoints(10, {1, -1, 0.1});
	EXPECT_EQ(thrusters.setPointsAt(10), Vector3d(0, 0, 0));
	EXPECT_LT((thrusters.setPointsAt(10.25) - Vector3d(0.5, -0.5, 0.1)).norm(), 1e-12);
	thrusters.setSetPoints(10.25, {-1, -1, 0.1});
	EXPECT_LT((thrusters.setPointsAt(10.35) - Vector3d(0.3, -0.7, 0.1)).norm(), 1e-12) << "from where it was";
	EXPECT_LT((thrusters.setPointsAt(99) - Vector3d(-1, -1, 0.1)).norm(), 1e-12);
}

TEST(Thrusters, PushWhereTheyStand)
{
	const CThrusters thrusters({});
	const Vector6d ahead = thrusters.wrench({1, 1, 0}), turn = thrusters.wrench({-1, 1, 0});
	EXPECT_LT((ahead - (Vector6d() << 2, 0, 0, 0, 0, 0).finished()).norm(), 1e-12);
	EXPECT_NEAR(turn[5], 0.334, 1e-12) << "port ahead turns to starboard";
	EXPECT_LT((thrusters.wrench({0, 0, 1}) - (Vector6d() << 0, 0, 1, 0, 0, 0).finished()).norm(), 1e-12);
	TThrusterOptions moved;
	moved.port_position = {-0.5, -0.2, 0.1};
	moved.heave_position = {0.1, 0, 0};
	EXPECT_NEAR(CThrusters(moved).wrench({0, 1, 0})[4], 0.1, 1e-12) << "below the origin: bow up";
	EXPECT_NEAR(CThrusters(moved).wrench({0, 0, 1})[4], -0.1, 1e-12) << "down at the bow: bow down";
}

TEST(Thrusters, LoseThrustWithSpeedOnlyWhenAsked)
{
	TThrusterOptions o;
	EXPECT_EQ(steadyThrusts(o, {1, 1, 1}, 2), steadyThrusts(o, {1, 1, 1}));
	o.zero_thrust_speed = 4;
	EXPECT_NEAR(steadyThrusts(o, {1, 1, 1}, 1)[0], 71.5 * 0.75, 1e-9);
	EXPECT_NEAR(steadyThrusts(o, {1, 1, 1}, 4)[1], 0, 1e-9);
	EXPECT_NEAR(steadyThrusts(o, {0.5, 0, 0}, 2)[0], 0, 1e-9) << "half the propeller's speed, half the limit";
	EXPECT_LT(steadyThrusts(o, {-1, 0, 0}, 1)[0], -30) << "backing against the flow";
	EXPECT_NEAR(steadyThrusts(o, {1, 1, 1}, 1)[2], 55, 1e-9) << "the heave thruster sees no flow along";
}

TEST(Thrusters, EfficiencyIsAFactorOnTheThrust)
{
	CVehicleDynamics vehicle({}, instantSetPoints(), {}, kNoFloor, 1, poseAt(50));
	vehicle.setSetPoints({0.5, 0.5, -0.5});
	vehicle.setEfficiency({0, 0.4, 1});
	vehicle.advanceTo(20);
	EXPECT_LT((vehicle.thrusts() - Vector3d(0, 0.4 * 71.5 / 4, -28.5 / 4)).norm(), 1e-6);
}

TEST(Thrusters, NonsenseIsRefused)
{
	CThrusters thrusters({});
	expectRefused([&] { thrusters.setSetPoints(0, {0, std::nan(""), 0}); }, {"set-points"});
	TThrusterOptions o;
	o.time_constant[1] = 1e-3;
	expectRefused(
		[&] { CVehicleDynamics({}, o, {}, kNoFloor, 1, poseAt(1)); }, {"[Thrusters] time_constant"});
}
