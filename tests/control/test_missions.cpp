#include "plant.h"

#include <gtest/gtest.h>
#include <posidonia/control/safe_correction.h>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector2d;

namespace
{
/** Largest cross-track error of a step's run along its line, from `from` m on. */
double worstCross(const TRun& run, size_t step, double from)
{
	double worst = 0;
	for (const auto& out : run.outputs)
		if (out.step == step && out.leg.phase == ELegPhase::RUN && out.leg.along > from)
			worst = std::max(worst, std::abs(out.leg.cross));
	return worst;
}

/** Largest change of the unlimited command from step to step between two times [s]. */
double largestChange(const TRun& run, double TVelocityCommand::*axis, double from, double to)
{
	double largest = 0;
	for (size_t i = 1; i < run.outputs.size(); i++)
		if (run.outputs[i].stamp >= from && run.outputs[i].stamp <= to)
			largest = std::max(
				largest, std::abs(run.outputs[i].unlimited.*axis - run.outputs[i - 1].unlimited.*axis));
	return largest;
}

TAutopilotOptions withoutObserver(double integral_gain)
{
	TAutopilotOptions options;
	options.current_observer.enabled = false;
	options.guidance.integral_gain = integral_gain;
	return options;
}
}  // namespace

TEST(Missions, ALegInACurrentAcrossIsFollowedOnceSettled)
{
	for (const Vector2d& current : {Vector2d(0, 0), Vector2d(0, 0.1), Vector2d(0, -0.1)}) {
		CPlant plant;
		plant.current = current;
		const TRun run = runMission(plant, {}, missionOf({legTo(24, 0, 0.5)}), 300);
		EXPECT_TRUE(run.finished) << current.transpose();
		EXPECT_LT(worstCross(run, 0, 8), 0.1) << current.transpose();
	}
}

TEST(Missions, PlainLineOfSightSettlesOffTheLineAndTheIntegralBringsItBack)
{
	// No cross velocity: surge over ground 0.3 m/s at the angle a, tan(a) = 0.1 cos(a) / 0.3, and e = Delta
	// tan(a).
	double angle = 0;
	for (int i = 0; i < 50; i++)
		angle = std::atan(std::cos(angle) / 3);
	const double expected = TGuidanceOptions().look_ahead * std::tan(angle);
	CPlant plain;
	plain.current = {0, 0.1};
	const TRun off = runMission(plain, withoutObserver(0), missionOf({legTo(60, 0, 0.5)}), 260);
	EXPECT_NEAR(off.outputs[1500].leg.cross, expected, 0.05 * expected);
	CPlant integral;
	integral.current = {0, 0.1};
	const TRun on = runMission(integral, withoutObserver(0.1), missionOf({legTo(60, 0, 0.5)}), 260);
	EXPECT_LT(std::abs(on.outputs[1500].leg.cross), 0.1);
}

TEST(Missions, ACornerIsTurnedOnTheSpot)
{
	CPlant plant;
	const TRun run =
		runMission(plant, {}, missionOf({legTo(6, 0, 0.5), legTo(6, 6, 0.5), legTo(0, 6, 0.5)}), 300);
	EXPECT_TRUE(run.finished);
	for (size_t i = 0; i < run.outputs.size(); i++) {
		const auto& out = run.outputs[i];
		if (out.leg.phase != ELegPhase::TURN) continue;
		EXPECT_LT((run.states[i].horizontal() - out.leg.start).norm(), 0.2) << "t=" << out.stamp;
	}
	EXPECT_LT(worstCross(run, 1, 0), 0.1);
	EXPECT_LT(worstCross(run, 2, 0), 0.1);
}

TEST(Missions, TheEndIsReachedWithinToleranceAndNotOvershot)
{
	for (double length : {1.0, 5.0, 24.0}) {
		CPlant plant;
		const TRun run = runMission(plant, {}, missionOf({legTo(length, 0, 0.5), holdFor(20, 0.5)}), 300);
		ASSERT_TRUE(run.finished) << "length=" << length;
		EXPECT_EQ(run.count(EMissionEvent::STEP_REACHED), 2) << "length=" << length;
		double furthest = 0;
		for (const auto& state : run.states)
			furthest = std::max(furthest, state.north());
		EXPECT_LT(furthest, length + 0.05) << "length=" << length;
		EXPECT_NEAR(plant.position.x(), length, 0.05) << "length=" << length;
	}
}

TEST(Missions, StationIsKeptWithAndWithoutCurrent)
{
	for (const Vector2d& current : {Vector2d(0, 0), Vector2d(0.1, 0), Vector2d(-0.06, 0.08)}) {
		CPlant plant;
		plant.current = current;
		TStep hold = holdFor(180, 1);
		hold.end = {0, 0};
		hold.has_end = true;
		const TRun run = runMission(plant, {}, missionOf({hold}), 300);
		double worst = 0;
		for (const auto& state : run.states)
			if (state.stamp > 90) worst = std::max(worst, state.horizontal().norm());
		EXPECT_LT(worst, current.isZero() ? 0.05 : 0.15) << current.transpose();
	}
}

TEST(Missions, TheSpeedOnALegIsTheOneAskedFor)
{
	for (double speed : {0.2, 0.3, 0.4}) {
		CPlant plant;
		TStep leg = legTo(20, 0, 0.5);
		leg.speed = speed;
		const TRun run = runMission(plant, {}, missionOf({leg}), 300);
		for (size_t i = 0; i < run.outputs.size(); i++) {
			const auto& out = run.outputs[i];
			if (out.leg.along < 6 || out.leg.along > 16) continue;
			EXPECT_NEAR(run.states[i].v_body.x(), speed, 0.02) << "t=" << out.stamp;
		}
	}
}

TEST(Missions, AStepThatCannotBeReachedTimesOut)
{
	CPlant plant;
	plant.efficiency = {0, 0, 1};
	TMission mission = missionOf({legTo(5, 0, 0), holdFor(5, 0)});
	mission.steps[0].timeout = 30;
	const TRun next = runMission(plant, {}, mission, 300);
	EXPECT_EQ(next.count(EMissionEvent::STEP_TIMED_OUT), 1);
	EXPECT_EQ(next.count(EMissionEvent::MISSION_DONE), 1);

	CPlant again;
	again.efficiency = {0, 0, 1};
	mission.options.on_timeout = "abort";
	const TRun abort = runMission(again, {}, mission, 300);
	EXPECT_EQ(abort.count(EMissionEvent::MISSION_DONE), 0);
	EXPECT_EQ(abort.count(EMissionEvent::MISSION_ABORTED), 1);
	EXPECT_EQ(abort.outputs.back().level, ESafetyLevel::ABORT_AND_SURFACE);
}

TEST(Missions, AWeakThrusterIsMadeUpFor)
{
	CPlant plant;
	plant.efficiency = {0.6, 1, 1};
	const TRun run = runMission(plant, {}, missionOf({legTo(20, 0, 0.5), legTo(20, 10, 0.5)}), 300);
	EXPECT_TRUE(run.finished);
	EXPECT_EQ(run.count(EMissionEvent::STEP_TIMED_OUT), 0);
	EXPECT_LT(worstCross(run, 0, 8), 0.1);
	EXPECT_LT(worstCross(run, 1, 5), 0.15);
}

TEST(Missions, AForcedCorrectionDoesNotShowInTheCommands)
{
	// The odometry is wrong by 1 m and 5 deg; at t = 45 s SLAM says so.
	Vector6d wrong;
	wrong << 0, 1, 0, 0, 0, 5 * M_PI / 180;
	const Eigen::Isometry3d T_odom_map = retract(Eigen::Isometry3d::Identity(), wrong);
	const auto mission = missionOf({legTo(24, 0, 0.5), legTo(24, 6, 0.5)});
	CPlant reference;
	const TRun without = runMission(reference, {}, mission, 300);

	CPlant plant;
	CSafeCorrection safe{TControllerPoseOptions()};
	double jump = 0, converged = 0;
	const TFault slam = [&](double t, CPlant&, TControlState& s, TVehicleHealth&) {
		const Eigen::Isometry3d T_odom_body = T_odom_map * s.T_map_body;
		if (t > 45) safe.setTarget(T_odom_map.inverse());
		safe.advance(t, T_odom_body);
		if (t > 45 && jump == 0) jump = safe.remaining().head<3>().norm();
		if (t > 45 && !safe.correcting() && converged == 0) converged = t;
		s.T_map_body = safe.T_map_body();
	};
	const TRun with = runMission(plant, {}, mission, 300, 0, slam);
	EXPECT_TRUE(with.finished);
	EXPECT_GT(jump, 1.5) << "the turn about the origin adds to the metre";
	EXPECT_GT(converged, 45);
	EXPECT_LT(converged - 45, jump / TControllerPoseOptions().position_rate + 1);
	for (auto axis : {&TVelocityCommand::yaw_rate, &TVelocityCommand::surge})
		EXPECT_LT(largestChange(with, axis, 43, converged + 2), 1.5 * largestChange(without, axis, 0, 300));
}

TEST(Missions, TheSameRunGivesTheSameBytes)
{
	const auto run = [] {
		CPlant plant;
		plant.current = {0.05, 0.02};
		runMission(plant, {}, missionOf({diveTo(2), legTo(5, 5, 2)}), 300);
		return plant.position;
	};
	EXPECT_EQ(run(), run());
}
