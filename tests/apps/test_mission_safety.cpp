#include "mission_testing.h"

namespace fs = std::filesystem;
using namespace posidonia;
using namespace posidonia::testing;

namespace
{
using L = ESafetyLevel;

/** What goes wrong, the rule that it must fire in the whole loop, and how severe things get. */
struct TCase
{
	std::string rule, ini, mission;
	std::vector<std::string> sets;	///< Section.key=value
	ESafetyLevel level;
	bool afloat;  ///< The vehicle ends at the surface
};

std::ostream& operator<<(std::ostream& out, const TCase& c)
{
	return out << c.rule;
}

const char* const kSurface = "[Mission]\n[Step.1]\nkind = hold\nduration = 45\ndepth = 0\n";
const char* const kLow = "[Mission]\n[Step.1]\nkind = dive\ndepth = 5.3\ntimeout = 25\n";
const char* const kHurried =
	"[Mission]\ntimeout = 12\n[Step.1]\nkind = dive\ndepth = 3.5\n[Step.2]\nkind = hold\nduration = 60\n";

std::string silent(const std::string& label)
{
	return "[Fault." + label + "]\nkind = drop_out\nlabel = " + label + "\ntime = 10\nduration = 0\n";
}
std::string flow(const std::string& velocity)
{
	return "[Fault.flow]\nkind = current\ntime = 8\nduration = 12\nvelocity = " + velocity + "\n";
}
std::string safety(const std::string& keys)
{
	return "[Safety]\n" + keys + "\n";
}

const std::string kDown = flow("0 0 0.6") + safety("max_depth = 3.7\ndepth_margin = 0.3"),
				  kSilence = silent("IMU") + silent("DVL") + silent("PRESSURE") + silent("AHRS");
const std::vector<std::string> kBlindDvl{"SimulatedDvl.max_slant_range=1"},
	kFixes{"Simulation.gps=true", "Route.start=0 0 0 90", "InitialPose.z=0"};

const std::vector<TCase>& cases()
{
	static const std::vector<TCase> all{
		{"low altitude", "", kLow, {}, L::INFORMATIVE, false},
		{"deep", kDown, kTinyMission, {}, L::ABORT_AND_SURFACE, true},
		{"too deep", kDown, kTinyMission, {}, L::ABORT_AND_SURFACE, true},
		{"outside the cage",
		 flow("0 0.8 0") + safety("cage = -1 -1 2 2.6"),
		 kTinyMission,
		 {},
		 L::ABORT,
		 false},
		{"stale navigation",
		 kSilence + safety("drop_weight_after = 20"),
		 kTinyMission,
		 {},
		 L::DROP_WEIGHT,
		 false},
		{"no depth", silent("PRESSURE"), kTinyMission, {}, L::EMERGENCY_SURFACE, true},
		{"no IMU", silent("IMU"), kTinyMission, {}, L::ABORT_AND_SURFACE, true},
		{"no DVL", silent("DVL"), kTinyMission, {}, L::ABORT_AND_SURFACE, true},
		{"no good DVL", "", kTinyMission, kBlindDvl, L::ABORT_AND_SURFACE, true},
		{"no altitude", safety("altitude_timeout = 15"), kTinyMission, kBlindDvl, L::ABORT_AND_SURFACE, true},
		{"no position", silent("GPS"), kSurface, kFixes, L::INFORMATIVE, true},
		{"battery low", "", kTinyMission, {"ClosedLoop.endurance=0.01"}, L::ABORT_AND_SURFACE, true},
		{"battery warning", "", kTinyMission, {"ClosedLoop.endurance=0.01"}, L::ABORT_AND_SURFACE, true},
		{"mission time-out", "", kHurried, {}, L::ABORT_AND_SURFACE, true},
		{"never navigated",
		 safety("drop_weight_after = 5"),
		 kHurried,
		 {"InitialPose.known=false"},
		 L::DROP_WEIGHT,
		 false},
		{"not rising",
		 silent("PRESSURE") + safety("drop_weight_after = 3"),
		 kTinyMission,
		 {},
		 L::DROP_WEIGHT,
		 false}};
	return all;
}

class MissionSafety : public ::testing::TestWithParam<TCase>
{
};
std::string nameOf(const ::testing::TestParamInfo<TCase>& info)
{
	std::string name = info.param.rule;
	for (char& c : name)
		if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
	return name;
}
}  // namespace

/** No pictures: the rules do not look at them. */
TEST_P(MissionSafety, ARuleFiresInTheWholeLoopAndEndsIt)
{
	const TCase& c = GetParam();
	const CTinyMission mission(c.ini, c.mission);
	CMissionApp app;
	std::vector<std::string> args{
		"--set", "Simulation.stereo=false", "--set", "ClosedLoop.pose_source=odometry"};
	for (const std::string& set : c.sets)
		args.insert(args.end(), {"--set", set});
	mission.fly(app, "run", args);
	const auto& last = app.results().steps.back();
	EXPECT_HOLDS(fileBytes(app.results().folder + "/events.csv"), c.rule);
	EXPECT_EQ(last.output.finished, true);
	EXPECT_EQ(app.exitStatus(), c.level >= L::ABORT ? 1 : 0) << app.results().aborted;
	L worst = L::NONE;
	for (const auto& step : app.results().steps)
		worst = std::max(worst, step.output.level);
	EXPECT_EQ(toString(worst), toString(c.level));
	if (c.afloat) {
		EXPECT_LT(last.truth.T_map_body.translation().z(), 0.5) << "it is at the surface";
	}
	EXPECT_TRUE(fs::exists(app.results().folder + "/metrics.json")) << "the run folder is whole";
}
INSTANTIATE_TEST_SUITE_P(Faults, MissionSafety, ::testing::ValuesIn(cases()), nameOf);

TEST(MissionSafetyTable, EveryRuleIsFiredInTheWholeLoop)
{
	for (const auto& rule : safetyRules()) {
		const auto is = [&](const TCase& c) { return c.rule == rule.name; };
		EXPECT_TRUE(std::any_of(cases().begin(), cases().end(), is)) << rule.name;
	}
}

TEST(MissionSafetyTable, AVehicleNearTheFloorClimbs)
{
	const CTinyMission mission("", kLow);
	CMissionApp app;
	mission.fly(app, "run", {"--set", "Simulation.stereo=false", "--set", "ClosedLoop.pose_source=odometry"});
	double lowest = 10;
	for (const auto& step : app.results().steps)
		lowest = std::min(lowest, step.true_altitude);
	EXPECT_LT(lowest, app.params.autopilot.safety.min_altitude) << "the rule had to fire";
	EXPECT_GT(lowest, 0.8) << "asked for 0.7 m, and kept from it";
}

TEST(MissionSafetyTable, EventsSayWhenFaultsBeginAndEnd)
{
	const CTinyMission mission(flow("0.1 0 0"));
	CMissionApp app;
	mission.fly(app, "run", {"--set", "Simulation.stereo=false", "--set", "ClosedLoop.pose_source=odometry"});
	const std::string events = fileBytes(app.results().folder + "/events.csv");
	EXPECT_HOLDS(events, "8.00,fault begins,\"flow\"");
	EXPECT_HOLDS(events, "20.00,fault ends,\"flow\"");
}
