#include "plant.h"

#include <gtest/gtest.h>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** A healthy vehicle at 3 m depth and 3 m altitude. */
struct TVehicle
{
	TControlState navigation;
	TVehicleHealth health;
	TSafetyOptions limits;

	TVehicle()
	{
		navigation.valid = true;
		navigation.T_map_body.translation().z() = 3;
		navigation.altitude = 3;
		health.stamp = 100;
		limits.cage = {-10, -10, 10, 10};
	}
	TSafetyDecision decision() const { return CSafetySupervisor(limits, 3600).update(navigation, health); }
	void place(double north, double east, double depth)
	{
		navigation.T_map_body.translation() = Eigen::Vector3d(north, east, depth);
	}
};

/** A fault for each rule: just short of the limit, and just past it. */
struct TCase
{
	const char* rule;
	std::function<void(TVehicle&)> short_of, past;
};

const std::vector<TCase>& cases()
{
	static const std::vector<TCase> all{
		{"low altitude", [](TVehicle& v) { v.navigation.altitude = 1.01; },
		 [](TVehicle& v) { v.navigation.altitude = 0.99; }},
		{"deep", [](TVehicle& v) { v.place(0, 0, 19.99); }, [](TVehicle& v) { v.place(0, 0, 20.01); }},
		{"too deep", [](TVehicle& v) { v.place(0, 0, 21.99); }, [](TVehicle& v) { v.place(0, 0, 22.01); }},
		{"outside the cage", [](TVehicle& v) { v.place(9.99, -9.99, 3); },
		 [](TVehicle& v) { v.place(0, -10.01, 3); }},
		{"stale navigation", [](TVehicle& v) { v.health.navigation_age = 1.99; },
		 [](TVehicle& v) { v.health.navigation_age = 2.01; }},
		{"no depth", [](TVehicle& v) { v.health.depth_age = 9.9; },
		 [](TVehicle& v) { v.health.depth_age = 10.1; }},
		{"no IMU", [](TVehicle& v) { v.health.imu_age = 9.9; }, [](TVehicle& v) { v.health.imu_age = 10.1; }},
		{"no DVL", [](TVehicle& v) { v.health.dvl_age = 9.9; }, [](TVehicle& v) { v.health.dvl_age = 10.1; }},
		{"no good DVL", [](TVehicle& v) { v.health.good_dvl_age = 19.9; },
		 [](TVehicle& v) { v.health.good_dvl_age = 20.1; }},
		{"no altitude", [](TVehicle& v) { v.health.altitude_age = 59.9; },
		 [](TVehicle& v) { v.health.altitude_age = 60.1; }},
		{"no position",
		 [](TVehicle& v) {
			 v.health.position_age = 1000;	// deep: none is expected
			 v.place(0, 0, 1.1);
		 },
		 [](TVehicle& v) {
			 v.health.position_age = 31;
			 v.place(0, 0, 0.2);
		 }},
		{"battery low", [](TVehicle& v) { v.health.battery = 0.151; },
		 [](TVehicle& v) { v.health.battery = 0.149; }},
		{"battery warning", [](TVehicle& v) { v.health.battery = 0.226; },
		 [](TVehicle& v) { v.health.battery = 0.224; }},
		{"mission time-out", [](TVehicle& v) { v.health.mission_time = 3599; },
		 [](TVehicle& v) { v.health.mission_time = 3601; }},
		{"never navigated",
		 [](TVehicle& v) {
			 v.navigation.valid = false;
			 v.health.initialised_for = 0;
			 v.health.mission_time = 3599;
		 },
		 [](TVehicle& v) {
			 v.navigation.valid = false;
			 v.health.initialised_for = 0;
			 v.health.mission_time = 3601;
		 }}};
	return all;
}

const TSafetyRule& ruleNamed(const std::string& name)
{
	for (const auto& rule : safetyRules())
		if (rule.name == name) return rule;
	throw std::runtime_error("no rule " + name);
}

bool names(const TSafetyDecision& decision, const std::string& rule)
{
	return (", " + decision.rules + ",").find(", " + rule + ",") != std::string::npos;
}
}  // namespace

TEST(SafetySupervisor, AHealthyVehicleIsLeftAlone)
{
	const TSafetyDecision decision = TVehicle().decision();
	EXPECT_EQ(decision.level, ESafetyLevel::NONE);
	EXPECT_EQ(decision.rules, "");
	EXPECT_FALSE(decision.climb);
}

TEST(SafetySupervisor, EachRuleFiresPastItsLimitAndNotBefore)
{
	for (const auto& c : cases()) {
		TVehicle good, bad;
		c.short_of(good);
		c.past(bad);
		EXPECT_FALSE(names(good.decision(), c.rule)) << c.rule;
		const TSafetyDecision decision = bad.decision();
		EXPECT_TRUE(names(decision, c.rule)) << c.rule << ": " << decision.rules;
		EXPECT_GE(decision.level, ruleNamed(c.rule).level) << c.rule;
		EXPECT_EQ(decision.climb, ruleNamed(c.rule).climbs) << c.rule;
	}
}

TEST(SafetySupervisor, EveryRuleOfTheTableHasItsFault)
{
	for (const auto& rule : safetyRules()) {
		const auto is = [&](const TCase& c) { return std::string(c.rule) == rule.name; };
		const bool tested = std::any_of(cases().begin(), cases().end(), is);
		EXPECT_TRUE(tested || std::string(rule.name) == "not rising") << rule.name;
	}
}

TEST(SafetySupervisor, TheLimitKeysExist)
{
	const auto keys = listOptions(TSafetyOptions());
	for (const auto& rule : safetyRules()) {
		const std::string key = rule.limit_key;
		const auto is = [&](const TOptionDoc& row) { return row.key == key; };
		EXPECT_TRUE(key[0] == '[' || std::any_of(keys.begin(), keys.end(), is)) << rule.name << ": " << key;
	}
}

TEST(SafetySupervisor, WarningsEndAndAbortsStay)
{
	TVehicle v;
	CSafetySupervisor supervisor(v.limits, 3600);
	v.health.battery = 0.2;
	EXPECT_EQ(supervisor.update(v.navigation, v.health).level, ESafetyLevel::INFORMATIVE);
	v.health.battery = 1;
	EXPECT_EQ(supervisor.update(v.navigation, v.health).level, ESafetyLevel::NONE);
	v.health.imu_age = 11;
	EXPECT_EQ(supervisor.update(v.navigation, v.health).level, ESafetyLevel::ABORT_AND_SURFACE);
	v.health.imu_age = 0;
	EXPECT_EQ(supervisor.update(v.navigation, v.health).level, ESafetyLevel::ABORT_AND_SURFACE);
}

TEST(SafetySupervisor, AbortsWaitUntilTheFilterHasSettledAndEmergenciesDoNot)
{
	TVehicle v;
	v.health.initialised_for = 4;
	v.health.dvl_age = 11;
	EXPECT_EQ(v.decision().level, ESafetyLevel::INFORMATIVE);
	v.health.initialised_for = 6;
	EXPECT_EQ(v.decision().level, ESafetyLevel::ABORT_AND_SURFACE);
	v.health.initialised_for = 4;
	v.health.navigation_age = 3;
	EXPECT_EQ(v.decision().level, ESafetyLevel::EMERGENCY_SURFACE);
}

TEST(SafetySupervisor, AnEmergencyThatDoesNotRiseDropsTheWeight)
{
	TVehicle v;
	v.navigation.valid = false;
	v.health.navigation_age = 3;
	CSafetySupervisor supervisor(v.limits, 3600);
	EXPECT_EQ(supervisor.update(v.navigation, v.health).level, ESafetyLevel::EMERGENCY_SURFACE);
	v.health.stamp += v.limits.drop_weight_after - 1;
	EXPECT_EQ(supervisor.update(v.navigation, v.health).level, ESafetyLevel::EMERGENCY_SURFACE);
	v.health.stamp += 2;
	EXPECT_EQ(supervisor.update(v.navigation, v.health).level, ESafetyLevel::DROP_WEIGHT);
}

TEST(SafetySupervisor, AnInvalidPoseFiresNothingThatNeedsOne)
{
	TVehicle v;
	v.navigation.valid = false;
	v.place(1000, 1000, 1000);
	v.navigation.altitude = 0.1;
	EXPECT_EQ(v.decision().rules, "");
}

namespace
{
const TStep kLong = legTo(60, 0, 5);

/** Runs a long leg at 5 m depth with a fault from t = 40 s on. */
TRun withFault(
	CPlant& plant, const std::function<void(double, CPlant&, TControlState&, TVehicleHealth&)>& fault,
	double longest, const TAutopilotOptions& options = {})
{
	return runMission(
		plant, options, missionOf({diveTo(5), kLong}), longest, 0,
		[&](double t, CPlant& p, TControlState& s, TVehicleHealth& h) {
			if (t > 40) fault(t - 40, p, s, h);
		});
}
}  // namespace

TEST(SafetyInClosedLoop, AbortAndSurfaceComesUpByTheControllers)
{
	CPlant plant;
	const TRun run = withFault(
		plant, [](double, CPlant&, TControlState&, TVehicleHealth& h) { h.dvl_age = 11; }, 200);
	EXPECT_TRUE(run.finished);
	EXPECT_LT(plant.position.z(), 0.3);
	EXPECT_EQ(run.count(EMissionEvent::MISSION_ABORTED), 1);
	EXPECT_LT(run.states.back().stamp, 40 + 5 / 0.3 + 15) << "at about ascent_speed";
}

TEST(SafetyInClosedLoop, AbortStops)
{
	CPlant plant;
	TAutopilotOptions options;
	options.safety.cage = {-5, -5, 4, 5};
	const TRun run = runMission(plant, options, missionOf({diveTo(5), kLong}), 300, 20);
	EXPECT_TRUE(run.finished);
	EXPECT_EQ(run.outputs.back().level, ESafetyLevel::ABORT);
	EXPECT_LT(run.states.back().v_body.norm(), 0.05);
	EXPECT_LT(plant.position.x(), 5);
	EXPECT_NEAR(plant.position.z(), 5, 0.2);
}

TEST(SafetyInClosedLoop, NearTheFloorTheVehicleClimbsAndGoesOn)
{
	// A hill 3 m high stands at 7 to 16 m north; the mission flies 2.5 m over the plain in depth mode.
	CPlant plant;
	double lowest = 100, lowest_on_top = 100;
	const TFault floor = [&](double, CPlant& p, TControlState& s, TVehicleHealth&) {
		const double x = p.position.x();
		const double ramp = std::clamp(std::min(x - 3, 20 - x) / 4, 0.0, 1.0);
		s.altitude = 7.5 - 3 * ramp - p.position.z();
		lowest = std::min(lowest, *s.altitude);
		if (x > 9 && x < 14) lowest_on_top = std::min(lowest_on_top, *s.altitude);
	};
	const TRun run = runMission(plant, {}, missionOf({diveTo(5), legTo(30, 0, 5)}), 400, 0, floor);
	EXPECT_TRUE(run.finished);
	EXPECT_LT(plant.position.x(), 30.2);
	EXPECT_GT(plant.position.x(), 29.8);
	EXPECT_GT(lowest, 0.4);
	EXPECT_GT(lowest_on_top, 0.6) << "min_altitude is 1 m; it sinks back between climbs";
}

TEST(SafetyInClosedLoop, EmergencySurfacingNeedsNoNavigation)
{
	CPlant plant;
	const TSafetyOptions limits;
	const TRun run = withFault(
		plant,
		[](double since, CPlant&, TControlState& s, TVehicleHealth& h) {
			s = TControlState();  // nothing at all
			h.navigation_age = h.depth_age = since;
		},
		120);
	EXPECT_LT(plant.position.z(), 0.3);
	EXPECT_EQ(run.outputs.back().level, ESafetyLevel::EMERGENCY_SURFACE);
	double before = 0;
	for (const auto& out : run.outputs) {
		if (out.level != ESafetyLevel::EMERGENCY_SURFACE) continue;
		EXPECT_EQ(out.set_points.starboard, 0) << "t=" << out.stamp;
		EXPECT_LE(before - out.set_points.heave, limits.emergency_heave / limits.emergency_ramp * 0.1 + 1e-9)
			<< "t=" << out.stamp;
		before = out.set_points.heave;
	}
	EXPECT_NEAR(before, -limits.emergency_heave, 1e-9);
}

TEST(SafetyInClosedLoop, AShortGapStopsTheThrustersAndTheMissionGoesOn)
{
	CPlant plant;
	bool stopped = false;
	const TRun run = withFault(
		plant,
		[&](double since, CPlant&, TControlState&, TVehicleHealth& h) {
			if (since < 1.9) h.navigation_age = since;
		},
		400);
	for (const auto& out : run.outputs)
		if (out.stamp > 41.15 && out.stamp < 41.85) {
			stopped = true;
			EXPECT_EQ(out.set_points.port, 0) << "t=" << out.stamp;
			EXPECT_EQ(out.set_points.heave, 0) << "t=" << out.stamp;
		}
	EXPECT_TRUE(stopped);
	EXPECT_TRUE(run.finished);
	EXPECT_EQ(run.outputs.back().level, ESafetyLevel::NONE);
}
