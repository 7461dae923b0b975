#include "plant.h"

#include <gtest/gtest.h>

using namespace posidonia;
using namespace posidonia::testing;

TEST(Pid, ProportionalIntegralDerivative)
{
	CPid pid({2, 4, 0.5, 100});
	EXPECT_DOUBLE_EQ(pid.update(1, 0.5, 0.1), 1.0) << "the first call has no history";
	// I = 2 / 4 * 0.5 * 0.1, D = -2 * 0.5 * (0.6 - 0.5) / 0.1
	EXPECT_NEAR(pid.update(1.1, 0.6, 0.1), 1.0 + 0.025 - 1.0, 1e-12);
}

TEST(Pid, ASetPointStepGivesNoKick)
{
	CPid pid({2, 1e9, 0.5, 100});
	pid.update(0, 0, 0.1);
	EXPECT_NEAR(pid.update(1, 0, 0.1), 2, 1e-6) << "kp e alone";
}

TEST(Pid, TheIntegralIsClampedAndStandsWhileSaturated)
{
	CPid pid({1, 1, 0, 3});
	for (int i = 0; i < 1000; i++)
		pid.update(1, 0, 0.1);
	EXPECT_DOUBLE_EQ(pid.integral(), 3);

	CPid saturated({1, 1, 0, 3});
	saturated.update(1, 0, 0.1);
	saturated.noteSaturation(-5);  // less was given than wanted
	for (int i = 0; i < 100; i++)
		saturated.update(1, 0, 0.1);
	EXPECT_EQ(saturated.integral(), 0) << "pushes further: stands";
	saturated.update(-1, 0, 0.1);
	EXPECT_LT(saturated.integral(), 0) << "comes back at once";
}

TEST(Pid, AGapResets)
{
	CPid pid({1, 1, 0, 3});
	for (int i = 0; i < 10; i++)
		pid.update(1, 0, 0.1);
	EXPECT_GT(pid.integral(), 0.5);
	EXPECT_EQ(pid.update(1, 0, 0.21), 1) << "kp e alone";
}

TEST(PoseController, ThePitchIsAllowedFor)
{
	// dz/dt = -u sin(pitch) + w cos(pitch) must come out as the wish, 0.
	const CPoseController controller{TPoseControlOptions()};
	TControlState state;
	state.T_map_body.linear() = rotationFromYawPitchRoll(0.3, 0.2, 0);
	state.v_body.x() = 0.3;
	TGuidanceCommand guidance;
	guidance.heading.value = 0.3;
	const double w = controller.command(guidance, state).heave;
	EXPECT_NEAR((state.T_map_body.linear() * Eigen::Vector3d(0.3, 0, w)).z(), 0, 1e-12);
}

TEST(PoseController, TheHeadingErrorIsWrapped)
{
	const TPoseControlOptions options;
	const CPoseController controller{options};
	TControlState state;
	state.T_map_body.linear() = rotationFromYawPitchRoll(3.1, 0, 0);
	TGuidanceCommand guidance;
	guidance.heading.value = -3.1 + 4 * M_PI;
	EXPECT_NEAR(controller.command(guidance, state).yaw_rate, options.heading_gain * (2 * M_PI - 6.2), 1e-9);
}

TEST(PoseController, LimitsHoldAndTheUnlimitedCommandDoesNotKnowThem)
{
	const TPoseControlOptions options;
	CPoseController controller{options};
	TVelocityCommand last;
	for (int i = 0; i < 100; i++) {
		const TVelocityCommand now = controller.limited({5, -5, 5}, 0.1);
		EXPECT_LE(now.yaw_rate - last.yaw_rate, 0.1 * options.max_yaw_acceleration + 1e-12);
		EXPECT_LE(now.surge - last.surge, 0.1 * options.max_surge_acceleration + 1e-12);
		last = now;
	}
	EXPECT_DOUBLE_EQ(last.surge, options.max_surge);
	EXPECT_DOUBLE_EQ(last.heave, -options.max_heave);
	EXPECT_DOUBLE_EQ(last.yaw_rate, options.max_yaw_rate);
}

TEST(VelocityController, FeedForwardIsTheSteadyForce)
{
	TVelocityControlOptions options;
	CVelocityController controller(options);
	TWrench tau;
	for (int i = 0; i < 100; i++)
		tau = controller.update({0.3, 0.1, 0.2}, {0.3, 0.1, 0.2}, {}, {0.3, 0.1, 0.2}, 0.1);
	EXPECT_NEAR(tau.X, 8 * 0.3 + 36.4 * 0.09, 1e-6);
	EXPECT_NEAR(tau.Z, 30 * 0.1 + 89 * 0.01 + options.buoyancy, 1e-6);
	EXPECT_NEAR(tau.N, 5 * 0.2 + 15 * 0.04, 1e-6);
}

TEST(VelocityController, TheLeadMakesUpForTheThrustersLag)
{
	// A ramp of the force, through the lead and then the lag, comes out nearly unlagged.
	TVelocityControlOptions options;
	options.gain = {0, 0, 0};
	options.linear_drag = {1, 1, 1};
	options.quadratic_drag = {0, 0, 0};
	CVelocityController controller(options);
	double thrust = 0, wanted = 0;
	for (int i = 1; i <= 100; i++) {
		wanted = 0.05 * i;
		const double tau = controller.update({}, {}, {}, {wanted, 0, 0}, 0.1).X;
		thrust += 0.1 / 0.8 * (tau - thrust);
	}
	EXPECT_NEAR(thrust, wanted, 0.5 * 0.25) << "without the lead it lags by 0.8 s * 0.5 N/s = 0.4 N";
}

TEST(VelocityController, TheIntegralDoesNotWindUpWhenThrustersGiveNoMore)
{
	TVelocityControlOptions options;
	options.integral_limit = {1000, 1000, 1000};
	CVelocityController controller(options);
	const CThrusterAllocation allocation{TAllocationOptions()};
	for (int i = 0; i < 200; i++) {
		const TWrench tau = controller.update({20, 0, 0}, {1, 0, 0}, {}, {0, 0, 0}, 0.1);
		controller.noteAchieved(allocation.wrench(allocation.thrusts(tau)));
	}
	const TWrench back = controller.update({0, 0, 0}, {1, 0, 0}, {}, {0, 0, 0}, 0.1);
	EXPECT_LT(back.X, 0) << "200 steps of saturation left no integral";
}
