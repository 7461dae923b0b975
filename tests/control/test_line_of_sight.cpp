#include <gtest/gtest.h>
#include <posidonia/control/guidance_command.h>
#include <posidonia/control/line_of_sight.h>

#include <cmath>

using namespace posidonia;
using Eigen::Vector2d;

namespace
{
/** A point that moves at 0.3 m/s through the water where the line of sight tells it; the line goes north.
 * East after `duration`. */
double settledError(const TGuidanceOptions& options, double current_east, double east, double duration)
{
	CLineOfSight los(options);
	for (double t = 0; t < duration; t += 0.1)
		east += 0.1 * (0.3 * std::sin(los.update(east, 0.1)) + current_east);
	return east;
}
}  // namespace

TEST(LineOfSight, PlainSettlesOffTheLineInACurrentAndIntegralOnIt)
{
	TGuidanceOptions options;
	options.integral_gain = 0;
	// sin(atan(e / Delta)) = 0.1 / 0.3
	const double expected = options.look_ahead * std::tan(std::asin(1.0 / 3));
	EXPECT_NEAR(settledError(options, 0.1, 0, 300), expected, 1e-6);
	options.integral_gain = 0.04;
	EXPECT_NEAR(settledError(options, 0.1, 0, 600), 0, 1e-3);
	EXPECT_NEAR(settledError(options, -0.1, 2, 600), 0, 1e-3);
}

TEST(LineOfSight, TheIntegralIsBoundedAndSlowWhenFarOff)
{
	TGuidanceOptions options;
	options.integral_gain = 0.1;
	options.integral_limit = 0.5;
	CLineOfSight los(options);
	for (int i = 0; i < 10000; i++)
		los.update(1.0, 0.1);
	EXPECT_DOUBLE_EQ(los.integral(), 0.5);
	los.reset();
	los.update(100, 0.1);
	EXPECT_LT(los.integral(), 0.1 * 0.1 * options.look_ahead / 100 + 1e-12)
		<< "Delta / e of the gain at most";
}

TEST(LineOfSight, TheRateIsTheCoursesDerivative)
{
	CLineOfSight los{TGuidanceOptions()};
	for (int i = 0; i < 20; i++)
		los.update(0.4, 0.1);
	for (double e : {-2.0, -0.1, 0.0, 0.3, 1.5}) {
		const double h = 1e-6, rate = 0.07;
		const double numeric = (los.course(e + rate * h) - los.course(e - rate * h)) / (2 * h);
		EXPECT_NEAR(los.courseRate(e, rate), numeric, 1e-8) << "e=" << e;
	}
}

TEST(Steering, InACurrentAcrossTheBowGivesTheCrabAngle)
{
	// 0.3 m/s east wished, the current flows north: the bow goes south of east.
	const TSteering steering = steer({0, 0.3}, {0.1, 0}, M_PI / 2);
	EXPECT_NEAR(steering.heading, M_PI / 2 + std::atan2(0.1, 0.3), 1e-12);
	EXPECT_NEAR(steering.surge, 0.3, 1e-12);
	// Velocity through the water along that bow plus the current is the wish.
	const Vector2d bow(std::cos(steering.heading), std::sin(steering.heading));
	const double through = std::hypot(0.1, 0.3);
	EXPECT_LT((through * bow + Vector2d(0.1, 0) - Vector2d(0, 0.3)).norm(), 1e-12);
}

TEST(Steering, NoWishPointsIntoTheCurrent)
{
	const TSteering steering = steer({0, 0}, {0.1, 0}, 0);
	EXPECT_NEAR(std::abs(steering.heading), M_PI, 1e-12);
	EXPECT_EQ(steering.surge, 0);
}

TEST(Steering, SurgeWaitsForTheBow)
{
	EXPECT_EQ(alignment(0.2), 1);
	EXPECT_NEAR(alignment(-0.8), 0.5, 1e-12);
	EXPECT_EQ(alignment(2), 0);
}
