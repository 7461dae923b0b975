#include "vehicle_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector3d;

namespace
{
constexpr double kStep = 0.05;

TCurrentOptions gusty()
{
	TCurrentOptions o;
	o.gust_speed = 0.1, o.gust_time = 5;
	return o;
}
/** North velocity at every step. */
std::vector<double> northOf(const TCurrentOptions& o, uint64_t seed, int steps)
{
	CCurrent current(o, kStep, seed);
	std::vector<double> north;
	for (int i = 0; i < steps; i++, current.advance())
		north.push_back(current.at(i * kStep, 3).velocity.x());
	return north;
}
}  // namespace

TEST(Current, IsOffByDefault)
{
	CCurrent current({}, kStep, 1);
	for (int i = 0; i < 3000; i++, current.advance()) {
		const TWaterMotion water = current.at(i * kStep, 5);
		ASSERT_EQ(water.velocity, Vector3d(0, 0, 0)) << i;
		ASSERT_EQ(water.acceleration, Vector3d(0, 0, 0)) << i;
		ASSERT_EQ(water.shear, Vector3d(0, 0, 0)) << i;
	}
}

TEST(Current, FlowsWhitherItIsToldAndChangesWithDepth)
{
	TCurrentOptions o;
	o.speed = 0.2, o.direction = M_PI / 3, o.shear = -0.01;
	const CCurrent current(o, kStep, 1);
	const Vector3d direction(0.5, std::sqrt(3) / 2, 0);
	EXPECT_LT((current.at(0, 0).velocity - 0.2 * direction).norm(), 1e-12);
	EXPECT_LT((current.at(0, 5).velocity - 0.15 * direction).norm(), 1e-12);
	EXPECT_LT((current.at(0, 5).shear + 0.01 * direction).norm(), 1e-12);
}

TEST(Current, GustsHaveTheirSigmaAndCorrelation)
{
	const int lag = 100;  // one correlation time
	double square = 0, product = 0, n = 0;
	for (uint64_t seed = 1; seed <= 40; seed++) {
		const auto x = northOf(gusty(), seed, 8000);  // 80 correlation times
		for (size_t i = 0; i + lag < x.size(); i++)
			square += x[i] * x[i], product += x[i] * x[i + lag], n++;
	}
	// About 1600 independent values. Between its knots the way is smooth, which takes 3 % of the variance.
	EXPECT_NEAR(std::sqrt(square / n), 0.1, 0.005);
	EXPECT_NEAR(product / square, std::exp(-1.0), 0.08);
}

TEST(Current, AccelerationIsTheVelocitysDerivative)
{
	TCurrentOptions o = gusty();
	CCurrent current(o, kStep, 3);
	for (int i = 0; i < 500; i++, current.advance()) {
		const double t = (i + 0.5) * kStep, d = 1e-5;
		if (i == 200) current.setAdded(i * kStep, {0.2, -0.1, 0.05});
		if (i == 210) current.setAdded(i * kStep, {0, 0.3, 0});
		const Vector3d slope = (current.at(t + d, 3).velocity - current.at(t - d, 3).velocity) / (2 * d);
		ASSERT_LT((current.at(t, 3).acceleration - slope).norm(), 1e-8) << i;
	}
}

TEST(Current, WhatIsAddedComesWithItsTimeConstant)
{
	CCurrent current({}, kStep, 1);
	const Vector3d added(0.1, 0.2, 0);
	current.setAdded(5, added);
	EXPECT_LT(current.at(5, 0).velocity.norm(), 1e-15);
	EXPECT_LT((current.at(5.5, 0).velocity - (1 - std::exp(-1.0)) * added).norm(), 1e-12);
	const Vector3d before = current.at(5.6, 0).velocity;
	current.setAdded(5.6, {0, 0, 0});
	EXPECT_LT((current.at(5.6, 0).velocity - before).norm(), 1e-12) << "no jump";
	EXPECT_LT(current.at(20, 0).velocity.norm(), 1e-9);
}

TEST(Current, GustsFollowTheSeed)
{
	EXPECT_EQ(northOf(gusty(), 7, 500), northOf(gusty(), 7, 500));
	EXPECT_NE(northOf(gusty(), 7, 500), northOf(gusty(), 8, 500));
}
