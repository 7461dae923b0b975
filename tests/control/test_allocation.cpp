#include <gtest/gtest.h>
#include <posidonia/control/allocation.h>

#include <cmath>

using namespace posidonia;

namespace
{
const TAllocationOptions kOptions;

void expectInRange(const TThrusters& T, const std::string& what)
{
	for (double surge : {T.starboard, T.port}) {
		EXPECT_LE(surge, kOptions.surge_forward + 1e-9) << what;
		EXPECT_GE(surge, -kOptions.surge_reverse - 1e-9) << what;
	}
	EXPECT_LE(T.heave, kOptions.heave_forward + 1e-9) << what;
	EXPECT_GE(T.heave, -kOptions.heave_reverse - 1e-9) << what;
}
}  // namespace

TEST(Allocation, WhatCanBeGivenIsGiven)
{
	const CThrusterAllocation allocation(kOptions);
	for (double X : {-20.0, 0.0, 6.0, 100.0})
		for (double N : {-5.0, 0.0, 3.0})
			for (double Z : {-28.0, 0.0, 50.0}) {
				const TWrench w = allocation.wrench(allocation.thrusts({X, Z, N}));
				EXPECT_NEAR(w.X, X, 1e-9) << X << " " << N;
				EXPECT_NEAR(w.N, N, 1e-9) << X << " " << N;
				EXPECT_NEAR(w.Z, Z, 1e-9) << Z;
			}
}

TEST(Allocation, PortAheadTurnsToStarboard)
{
	const CThrusterAllocation allocation(kOptions);
	EXPECT_GT(allocation.wrench({0, 10, 0}).N, 0);
	EXPECT_LT(allocation.wrench({10, 0, 0}).N, 0);
}

TEST(Allocation, YawComesFirst)
{
	const CThrusterAllocation allocation(kOptions);
	for (double sign : {1.0, -1.0}) {
		// 0.167 (Tp - Ts) = 9 N m takes 27 N each way; ahead there are 44.5 N left, not 75.
		const TThrusters T = allocation.thrusts({150, 0, sign * 9});
		const TWrench w = allocation.wrench(T);
		expectInRange(T, "yaw and surge");
		EXPECT_NEAR(w.N, sign * 9, 1e-9);
		EXPECT_NEAR(w.X, 2 * (71.5 - 9 / (2 * 0.167)), 1e-9) << "surge takes all that is left";
	}
	const TThrusters T = allocation.thrusts({50, 0, 100});
	EXPECT_NEAR(allocation.wrench(T).N, 2 * 30 * 0.167, 1e-9) << "bounded by the reverse thrust";
	expectInRange(T, "yaw alone");
}

TEST(Allocation, NoThrusterLeavesItsRange)
{
	const CThrusterAllocation allocation(kOptions);
	for (double X = -200; X <= 200; X += 25)
		for (double N = -30; N <= 30; N += 3)
			expectInRange(allocation.thrusts({X, 3 * X, N}), std::to_string(X) + " " + std::to_string(N));
}

TEST(Allocation, SetPointsGiveTheThrustBack)
{
	const CThrusterAllocation allocation(kOptions);
	for (double T : {-28.0, -10.0, -0.5, 0.0, 0.5, 3.0, 28.4}) {
		const TThrusters back = allocation.thrustsOf(allocation.setPoints({T, T, T}));
		EXPECT_NEAR(back.starboard, T, 1e-9) << "T=" << T;
		EXPECT_NEAR(back.port, T, 1e-9) << "T=" << T;
		EXPECT_NEAR(back.heave, T, 1e-9) << "T=" << T;
	}
	EXPECT_EQ(allocation.setPoints({71.5, -30, -28.5}).starboard, 1);
	EXPECT_EQ(allocation.setPoints({71.5, -30, -28.5}).port, -1);
	EXPECT_EQ(allocation.setPoints({71.5, -30, -28.5}).heave, -1);
}

TEST(Allocation, InTheDeadBandTheNearestThrustIsTaken)
{
	const CThrusterAllocation allocation(kOptions);
	const double edge = kOptions.surge_forward * kOptions.dead_band * kOptions.dead_band;
	EXPECT_EQ(allocation.setPoints({0.4 * edge, 0, 0}).starboard, 0);
	EXPECT_EQ(allocation.setPoints({0.6 * edge, 0, 0}).starboard, kOptions.dead_band);
	EXPECT_EQ(allocation.thrustsOf({0.9 * kOptions.dead_band, 0, 0}).starboard, 0);
}
