#include "plant.h"

#include <gtest/gtest.h>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector2d;

namespace
{
/** Estimate after a leg and a turn in a current. */
Vector2d observed(const Vector2d& current, const TAutopilotOptions& options)
{
	CPlant plant;
	plant.current = current;
	const TRun run = runMission(plant, options, missionOf({legTo(10, 0, 1), legTo(10, 10, 1)}), 300);
	EXPECT_TRUE(run.finished);
	return run.outputs.back().current;
}
}  // namespace

TEST(CurrentObserver, FindsTheCurrentWhileTheVehicleMoves)
{
	for (const Vector2d& current : {Vector2d(0.1, 0), Vector2d(0, -0.1), Vector2d(-0.07, 0.07)})
		EXPECT_LT((observed(current, {}) - current).norm(), 0.02)
			<< current.transpose() << " (the dead zone takes a tenth)";
}

TEST(CurrentObserver, StillWaterIsNoCurrent)
{
	EXPECT_EQ(observed({0, 0}, {}), Vector2d(0, 0));
}

TEST(CurrentObserver, DisabledIsNoCurrent)
{
	TAutopilotOptions options;
	options.current_observer.enabled = false;
	EXPECT_EQ(observed({0.05, 0}, options), Vector2d(0, 0));
}

TEST(CurrentObserver, TheEstimateIsBounded)
{
	TCurrentObserverOptions options;
	options.max_current = 0.3;
	CCurrentObserver observer(options);
	for (int i = 0; i < 1000; i++)
		observer.update({0, 0, {0, 2}, 0}, 0.1);
	EXPECT_LE(observer.current().norm(), 0.3);
}
