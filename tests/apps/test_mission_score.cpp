#include <gtest/gtest.h>
#include <posidonia/apps/mission/mission_plots.h>
#include <posidonia/apps/mission/mission_score.h>
#include <posidonia/apps/mission/realtime_pacer.h>

#include <cmath>

using namespace posidonia;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
/** A step at t where the vehicle truly is `at`, on a leg along east through the origin. */
TControlStep legStep(double t, const Vector3d& at)
{
	TControlStep step;
	step.t = t;
	step.truth.T_map_body.translation() = at;
	step.truth.v_map = {0, 0.3, 0};
	step.true_altitude = 6 - at.z();
	step.feedback.navigation.valid = true;
	step.feedback.navigation.T_map_body = step.truth.T_map_body;
	step.output.leg.phase = ELegPhase::RUN;
	step.output.leg.end = {0, 10};
	step.output.depth_reference = 3.5;
	return step;
}

/** A leg to (0, 10) and a hold of which no point is named. */
TMission legAndHold()
{
	TMission mission;
	TStep leg, hold;
	leg.kind = EStepKind::SECTION;
	leg.end = {0, 10};
	leg.has_end = true;
	hold.kind = EStepKind::HOLD;
	mission.steps = {leg, hold};
	return mission;
}
}  // namespace

TEST(MissionScore, CrossTrackIsPositiveToStarboardAndOnlyOnLegs)
{
	EXPECT_NEAR(trueCrossTrack(legStep(0, {-0.2, 3, 3.5})), 0.2, 1e-12) << "south of a line to the east";
	EXPECT_NEAR(trueCrossTrack(legStep(0, {0.1, 3, 3.5})), -0.1, 1e-12);
	TControlStep turning = legStep(0, {0.1, 3, 3.5});
	turning.output.leg.phase = ELegPhase::TURN;
	EXPECT_TRUE(std::isnan(trueCrossTrack(turning)));
}

TEST(MissionScore, RowsFollowFromThePlantedErrors)
{
	std::vector<TControlStep> steps;
	for (int k = 0; k <= 100; k++)
		steps.push_back(legStep(0.1 * k, {k < 50 ? 0.1 : -0.3, 0.1 * k, 3.4}));
	for (int k = 1; k <= 10; k++) {
		TControlStep hold = legStep(10 + 0.1 * k, {0.03, 10.04, 3.5});
		hold.output.step = 1;
		hold.output.leg.phase = ELegPhase::NONE;
		steps.push_back(hold);
	}
	const TMetrics rows = missionMetrics(steps, legAndHold());
	EXPECT_NEAR(metric(rows, "mission.cross_track.mean"), (50 * 0.1 + 51 * 0.3) / 101, 1e-9);
	EXPECT_NEAR(metric(rows, "mission.cross_track.max"), 0.3, 1e-9);
	EXPECT_NEAR(metric(rows, "mission.depth_error.mean"), 0.1, 1e-9);
	EXPECT_NEAR(metric(rows, "mission.end_error.mean"), 0.05, 1e-9) << "from the last point that was named";
	EXPECT_NEAR(metric(rows, "mission.leg_speed"), 0.3, 1e-9);
	EXPECT_NEAR(metric(rows, "mission.leg_altitude"), 2.6, 1e-9);
	EXPECT_NEAR(metric(rows, "mission.duration"), 11, 1e-9);
}

TEST(MissionScore, ChangesOfCommandsAreFoundWhereTheyAre)
{
	std::vector<TControlStep> steps;
	for (int k = 0; k < 200; k++) {
		steps.push_back(legStep(0.1 * k, {0, 0, 3.5}));
		steps.back().output.unlimited.surge = k < 100 ? 0.3 : 0.2;			// one step down
		steps.back().output.unlimited.yaw_rate = 0.001 * std::min(k, 150);	// a ramp
	}
	const TMetrics rows = missionMetrics(steps, legAndHold());
	EXPECT_NEAR(metric(rows, "mission.surge_step.max"), 0.1, 1e-9);
	EXPECT_NEAR(metric(rows, "mission.surge_step.p99"), 0, 1e-9) << "one step of 199";
	EXPECT_NEAR(metric(rows, "mission.yaw_rate_step.p99"), 0.001, 1e-9);
	EXPECT_NEAR(metric(rows, "mission.yaw_rate_range.max"), 0.04, 1e-9) << "4 s of the ramp";
	EXPECT_NEAR(metric(rows, "mission.surge_range.max"), 0.1, 1e-9);
}

TEST(MissionScore, AJumpIsMeasuredUntilItIsTaken)
{
	std::vector<TControlStep> steps;
	for (int k = 0; k < 100; k++) {
		steps.push_back(legStep(0.1 * k, {0, 0, 3.5}));
		TControlStep& step = steps.back();
		step.feedback.T_map_body = step.feedback.navigation.T_map_body;
		if (k < 20) continue;
		step.feedback.T_map_body.translation().x() += std::max(0.0, 1 - 0.05 * (k - 20));
		step.feedback.correcting = k < 40;
	}
	const TMetrics rows = jumpMetrics(steps, 2.0);
	EXPECT_NEAR(metric(rows, "jump.distance"), 1, 1e-9);
	EXPECT_NEAR(metric(rows, "jump.settled_after"), 2, 1e-9);
	EXPECT_TRUE(jumpMetrics(steps, 0).empty()) << "no jump was asked for";
}

TEST(MissionScore, TablesHaveARowEachStep)
{
	std::vector<TControlStep> steps{legStep(0, {0, 0, 3.5}), legStep(0.1, {0, 0, 3.5})};
	steps[1].output.events.push_back({1000.1, EMissionEvent::STEP_STARTED, "Step.1"});
	const std::string csv = controlCsv(steps);
	EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
	const auto columns = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
	const size_t first = csv.find('\n'), second = csv.find('\n', first + 1);
	EXPECT_EQ(columns(csv.substr(0, first)), columns(csv.substr(first + 1, second - first - 1)));
	EXPECT_EQ(eventsCsv(steps, 1000), "t,kind,text\n0.10,step started,\"Step.1\"\n");
}

TEST(RealtimePacer, CountsWhatComesTooLate)
{
	CRealtimePacer pacer(true, 0.5);
	pacer.waitFor(100);
	EXPECT_EQ(pacer.missed(), 0);
	pacer.waitFor(90);	// due ten seconds before it began
	EXPECT_EQ(pacer.missed(), 1);
	EXPECT_GE(pacer.worst(), 10);
	CRealtimePacer idle(false, 0);
	idle.waitFor(0);
	idle.waitFor(-90);
	EXPECT_EQ(idle.missed(), 0);
}
