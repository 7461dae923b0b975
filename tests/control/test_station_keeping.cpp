#include <gtest/gtest.h>
#include <posidonia/control/station_keeping.h>
#include <posidonia/geometry/se3.h>

using namespace posidonia;
using Eigen::Vector2d;

TEST(StationKeeping, StillWaterKeepsTheBowWhenNear)
{
	CStationKeeping station{TGuidanceOptions()};
	const TSteering steering = station.update({0.03, 0.03}, {0, 0}, 0.5);
	EXPECT_EQ(steering.heading, 0.5);
	EXPECT_GT(steering.surge, 0) << "the part along the bow is removed all the same";
}

TEST(StationKeeping, StillWaterPointsAtThePointOrAwayFromIt)
{
	CStationKeeping ahead{TGuidanceOptions()};
	TSteering steering = ahead.update({1, 0}, {0, 0}, 0.4);
	EXPECT_NEAR(wrapAngle(steering.heading), 0, 1e-12);
	EXPECT_GT(steering.surge, 0);
	CStationKeeping astern{TGuidanceOptions()};
	steering = astern.update({-1, 0}, {0, 0}, 0.4);
	EXPECT_NEAR(wrapAngle(steering.heading), 0, 1e-12) << "goes astern instead of turning round";
	EXPECT_LT(steering.surge, 0);
}

TEST(StationKeeping, TheLeadingEndDoesNotDitherWhenThePointLiesAbeam)
{
	CStationKeeping station{TGuidanceOptions()};
	station.update({0, 1}, {0, 0}, 0);
	for (int i = 0; i < 20; i++) {
		const double heading = i % 2 ? 0.1 : -0.1;
		EXPECT_NEAR(station.update({0, 1}, {0, 0}, heading).heading, M_PI / 2, 1e-12) << "i=" << i;
	}
}

TEST(StationKeeping, ACurrentTurnsTheBowIntoItAndNeverAstern)
{
	CStationKeeping station{TGuidanceOptions()};
	EXPECT_NEAR(std::abs(station.update({0, 0}, {0.1, 0}, 0).heading), M_PI, 1e-12);
	// Off to the east: the bow goes off the current to the west of it (from south to south-west).
	const TSteering off = station.update({0, -0.1}, {0.1, 0}, M_PI);
	EXPECT_NEAR(wrapAngle(off.heading - M_PI), std::atan2(0.025, 0.1), 1e-12);
}

TEST(StationKeeping, SpeedIsProportionalAndBounded)
{
	const TGuidanceOptions options;
	CStationKeeping station{options};
	EXPECT_NEAR(station.update({0.2, 0}, {0, 0}, 0).surge, 0.2 * options.station_gain, 1e-12);
	EXPECT_NEAR(station.update({50, 0}, {0, 0}, 0).surge, options.station_speed, 1e-12);
}
