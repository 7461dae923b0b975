#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/base/ini_file.h>
#include <posidonia/control/mission.h>
#include <temp_folder.h>

#include <cmath>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector2d;

namespace
{
Vector2d flatEarth(double latitude, double longitude)
{
	return {(latitude - 41) * 111000, (longitude - 3) * 83000};
}

TMission read(const std::string& text)
{
	CIniFile ini = CIniFile::fromText(text, "m.ini");
	const TMission mission = loadMission(ini, flatEarth);
	ini.refuseUnknown();
	return mission;
}

std::string readError(const std::string& text)
{
	return errorOf<CError>([&] { read(text); });
}

std::string checkError(const std::string& text, const TSafetyOptions& limits)
{
	return errorOf<CError>([&] { checkMission(read(text), limits, {0, 0}); });
}

void expectHas(const std::string& text, const std::string& part)
{
	EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}
}  // namespace

TEST(MissionFile, ReadsEveryKind)
{
	const TMission mission = read(
		"[Mission]\nspeed = 0.4\ntolerance_xy = 0.2\n"
		"[Step.1]\nkind = dive\ndepth = 3.5\nvertical_speed = 0.1\n"
		"[Step.2]\nkind = goto\npoints = 1 2\nspeed = 0.3\ntimeout = 77\n"
		"[Step.3]\nkind = section\ngeodetic_points = 41.0001 3.0002\naltitude = 2.5\n"
		"[Step.4]\nkind = hold\nduration = 12\n"
		"[Step.5]\nkind = surface\n");
	ASSERT_EQ(mission.steps.size(), 5u);
	EXPECT_EQ(mission.steps[0].kind, EStepKind::DIVE);
	EXPECT_EQ(mission.steps[0].depth, 3.5);
	EXPECT_EQ(mission.steps[0].vertical_speed, 0.1);
	EXPECT_EQ(mission.steps[1].kind, EStepKind::GOTO);
	EXPECT_EQ(mission.steps[1].end, Vector2d(1, 2));
	EXPECT_EQ(mission.steps[1].speed, 0.3);
	EXPECT_EQ(mission.steps[1].tolerance_xy, 0.2) << "default of [Mission]";
	EXPECT_EQ(mission.steps[1].timeout, 77);
	EXPECT_EQ(mission.steps[1].depth, 3.5) << "inherited";
	EXPECT_EQ(mission.steps[2].kind, EStepKind::SECTION);
	EXPECT_EQ(mission.steps[2].speed, 0.4) << "default of [Mission]";
	EXPECT_NEAR((mission.steps[2].end - Vector2d(11.1, 16.6)).norm(), 0, 1e-6);
	EXPECT_TRUE(mission.steps[2].altitude_mode);
	EXPECT_EQ(mission.steps[2].altitude, 2.5);
	EXPECT_EQ(mission.steps[3].kind, EStepKind::HOLD);
	EXPECT_EQ(mission.steps[3].duration, 12);
	EXPECT_FALSE(mission.steps[3].has_end);
	EXPECT_TRUE(mission.steps[3].altitude_mode) << "inherited";
	EXPECT_EQ(mission.steps[4].kind, EStepKind::SURFACE);
	EXPECT_FALSE(mission.steps[4].altitude_mode);
}

TEST(MissionFile, ARouteIsOneSectionAPoint)
{
	const TMission mission = read("[Step.1]\nkind = route\npoints = 0 0 0 12 5 12\ndepth = 3.5\n");
	ASSERT_EQ(mission.steps.size(), 3u);
	EXPECT_EQ(mission.steps[2].end, Vector2d(5, 12));
	EXPECT_EQ(mission.steps[2].name, "Step.1 route 3/3");
	for (const auto& step : mission.steps)
		EXPECT_EQ(step.kind, EStepKind::SECTION);
}

TEST(MissionFile, ALawnMowerGoesToAndFroWithItsSpacing)
{
	const TMission mission = read(
		"[Step.1]\nkind = lawn-mower\npoints = 1 2\nheading = 90\nlength = 10\nspacing = 3\ntracks = "
		"3\ndepth = "
		"2\n");
	// Heading east, starboard is south.
	const std::vector<Vector2d> expected{{1, 2}, {1, 12}, {-2, 12}, {-2, 2}, {-5, 2}, {-5, 12}};
	ASSERT_EQ(mission.steps.size(), expected.size());
	for (size_t i = 0; i < expected.size(); i++)
		EXPECT_LT((mission.steps[i].end - expected[i]).norm(), 1e-12) << "point " << i;
}

TEST(MissionFile, ErrorsNameFileSectionAndKey)
{
	struct TCase
	{
		std::string text, section_and_key, problem;
	};
	const std::vector<TCase> cases{
		{"[Step.1]\nkind = fly\n", "[Step.1] kind", "fly"},
		{"[Step.1]\nkind = goto\npoints = 1 2 3\n", "[Step.1] points", "no list of pairs"},
		{"[Step.1]\nkind = goto\npoints = 1 2 3 4\n", "[Step.1] points", "2 points"},
		{"[Step.1]\nkind = route\n", "[Step.1] points", "0 points"},
		{"[Step.1]\nkind = goto\npoints = 1 x\n", "[Step.1] points", "is not a number"},
		{"[Step.1]\nkind = goto\npoints = 1 2\ngeodetic_points = 41 3\n", "[Step.1] geodetic_points",
		 "besides"},
		{"[Step.1]\nkind = dive\ndepth = 3\naltitude = 2\n", "[Step.1] altitude", "besides depth"},
		{"[Step.1]\nkind = dive\ndepth = 3 4\n", "[Step.1] depth", "one number"},
		{"[Step.1]\nkind = goto\npoints = 1 2\nspeed = 0\n", "[Step.1] speed", "must be > 0"},
		{"[Step.1]\nkind = goto\npoints = 1 2\nduration = 5\n", "[Step.1]", "unknown key 'duration'"},
		{"[Step.2]\nkind = dive\ndepth = 3\n", "[Step.1]", "no section"},
		{"[Mission]\non_timeout = panic\n", "[Mission] on_timeout", "panic"}};
	for (const auto& c : cases) {
		const std::string error = readError(c.text);
		expectHas(error, "m.ini");
		expectHas(error, c.section_and_key);
		expectHas(error, c.problem);
	}
}

TEST(MissionFile, ADatumIsNeededForLatitudes)
{
	CIniFile ini = CIniFile::fromText("[Step.1]\nkind = goto\ngeodetic_points = 41 3\n", "m.ini");
	expectHas(errorOf<CError>([&] { loadMission(ini, {}); }), "no datum");
}

TEST(MissionCheck, FindsWhatCannotBeDone)
{
	TSafetyOptions limits;
	limits.cage = {-20, -20, 20, 20};
	expectHas(checkError("", limits), "no steps");
	expectHas(checkError("[Step.1]\nkind = goto\npoints = 0 21\n", limits), "outside the cage");
	expectHas(checkError("[Step.1]\nkind = dive\ndepth = 21\n", limits), "max_depth");
	expectHas(checkError("[Step.1]\nkind = dive\naltitude = 0.5\n", limits), "min_altitude");
	expectHas(
		checkError("[Mission]\nmax_distance = 10\n[Step.1]\nkind = goto\npoints = 0 11\n", limits),
		"max_distance");
	EXPECT_EQ(checkError("[Step.1]\nkind = goto\npoints = 0 19\ndepth = 3\n", limits), "");
	limits.cage = {1, 2};
	expectHas(checkError("[Step.1]\nkind = dive\ndepth = 2\n", limits), "4 numbers");
}

TEST(MissionCheck, TheDefaultTimeoutIsThatOfCola2)
{
	TStep step;
	step.speed = 0.3;
	step.vertical_speed = 0.5;
	EXPECT_NEAR(defaultTimeout(step, 12, 0), 2 * std::sqrt(2.0) * 12 / 0.3 + 30, 1e-9);
	EXPECT_NEAR(defaultTimeout(step, 0, 3), 2 * 3 / 0.3 + 30, 1e-9) << "0.3 m/s at most";
	step.kind = EStepKind::HOLD;
	step.duration = 300;
	EXPECT_NEAR(defaultTimeout(step, 0, 0), 330, 1e-9) << "a long hold does not time out by itself";
}
