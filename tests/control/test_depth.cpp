#include "plant.h"

#include <gtest/gtest.h>
#include <posidonia/control/depth_guidance.h>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
TControlState at(double stamp, double depth, std::optional<double> altitude)
{
	TControlState s;
	s.stamp = stamp;
	s.T_map_body.translation().z() = depth;
	s.altitude = altitude;
	s.valid = true;
	return s;
}

TStep altitudeStep(double altitude)
{
	TStep step = holdFor(60, 0);
	step.altitude_mode = true;
	step.altitude = altitude;
	return step;
}
}  // namespace

TEST(DepthGuidance, AltitudeModeAddsUp)
{
	CDepthGuidance guidance{TGuidanceOptions()};
	EXPECT_DOUBLE_EQ(guidance.target(altitudeStep(2.5), at(0, 3, 3.2)), 3.7);
	EXPECT_EQ(guidance.target(altitudeStep(9), at(1, 3, 3.2)), 0) << "not above the surface";
	EXPECT_EQ(guidance.target(holdFor(1, 4), at(2, 3, 3.2)), 4) << "depth mode does not look at it";
}

TEST(DepthGuidance, ALostAltitudeIsExtrapolatedThenTheVehicleClimbs)
{
	CDepthGuidance guidance{TGuidanceOptions()};
	guidance.target(altitudeStep(2.5), at(0, 3, 3.2));
	EXPECT_NEAR(guidance.target(altitudeStep(2.5), at(4.9, 3.4, {})), 3.7, 1e-12) << "the floor stays";
	EXPECT_NEAR(guidance.target(altitudeStep(2.5), at(5.1, 3.4, {})), 3.4 + 0.5 - 2.5, 1e-12);
	EXPECT_NEAR(guidance.target(altitudeStep(2.5), at(6, 3.4, 2.8)), 3.7, 1e-12) << "and back";
}

TEST(DepthInClosedLoop, AStepDoesNotOvershoot)
{
	for (double depth : {0.5, 3.5, 8.0}) {
		CPlant plant;
		const TRun run = runMission(plant, {}, missionOf({diveTo(depth), holdFor(60, depth)}), 200);
		ASSERT_TRUE(run.finished) << "depth=" << depth;
		double deepest = 0;
		for (const auto& state : run.states)
			deepest = std::max(deepest, state.depth());
		EXPECT_LT(deepest, depth + 0.1) << "depth=" << depth;
		EXPECT_NEAR(plant.position.z(), depth, 0.02) << "the buoyancy is balanced";
	}
}

TEST(DepthInClosedLoop, TheIntegralFindsABuoyancyThatIsNotInTheIni)
{
	CPlant plant;
	plant.buoyancy = 8;
	runMission(plant, {}, missionOf({diveTo(3), holdFor(60, 3)}), 200);
	EXPECT_NEAR(plant.position.z(), 3, 0.03);
}

TEST(DepthInClosedLoop, AltitudeModeFollowsASlope)
{
	CPlant plant;
	TStep leg = legTo(20, 0, 0);
	leg.altitude_mode = true;
	leg.altitude = 2.5;
	const auto floor = [](const CPlant& p) { return 6 + 0.05 * p.position.x(); };
	double worst = 0;
	const TFault altimeter = [&](double t, CPlant& p, TControlState& s, TVehicleHealth&) {
		s.altitude = floor(p) - p.position.z();
		if (t > 40) worst = std::max(worst, std::abs(*s.altitude - 2.5));
	};
	const TRun run = runMission(plant, {}, missionOf({diveTo(3), leg}), 200, 0, altimeter);
	EXPECT_TRUE(run.finished);
	EXPECT_LT(worst, 0.1);
}
