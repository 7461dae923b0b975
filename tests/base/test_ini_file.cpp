#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/base/ini_file.h>
#include <temp_folder.h>

#include <cmath>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
struct TAll
{
	double radius{4};
	double angle{0.3};	///< [rad]
	int count{3};
	unsigned seed{7};
	bool enabled{true};
	std::string title{"a dive"};
	std::string mode{"fast"};
	std::vector<double> pose{1, 2, 3};
	std::vector<double> any;

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("radius", radius, above(0), "Radius [m]");
		v.degrees("angle", angle, between(-90, 90), "Angle [deg]");
		v.integer("count", count, between(1, 10), "Count");
		v.seed("seed", seed, "Seed");
		v.flag("enabled", enabled, "On or off");
		v.text("title", title, "Title");
		v.choice("mode", mode, {"fast", "exact"}, "Mode");
		v.numbers("pose", pose, 3, anyNumber(), "Three numbers");
		v.numbers("any", any, 0, atLeast(0), "Any count of numbers");
	}
};

struct TOther
{
	double depth{2};
	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("depth", depth, anyNumber(), "Depth [m]");
	}
};

TAll loaded(const std::string& lines)
{
	CIniFile ini = CIniFile::fromText("[Part]\n" + lines, "run.ini");
	const TAll all = ini.load<TAll>("Part");
	ini.refuseUnknown();
	return all;
}

std::string problemOf(const std::string& lines)
{
	return errorOf<CError>([&] { loaded(lines); });
}
}  // namespace

TEST(IniFile, ReadsEveryKind)
{
	const TAll all = loaded(
		"radius = 2.5e-1 // metres\nangle = 45\ncount = 9\nseed = 4294967295\nenabled = false\n"
		"title = another dive\nmode = exact\npose = -1 +2 3e2\nany = 1 2\n");
	EXPECT_EQ(all.radius, 0.25);
	EXPECT_DOUBLE_EQ(all.angle, M_PI / 4);
	EXPECT_EQ(all.count, 9);
	EXPECT_EQ(all.seed, 4294967295u);
	EXPECT_FALSE(all.enabled);
	EXPECT_EQ(all.title, "another dive");
	EXPECT_EQ(all.mode, "exact");
	EXPECT_EQ(all.pose, (std::vector<double>{-1, 2, 300}));
	EXPECT_EQ(all.any, (std::vector<double>{1, 2}));
}

TEST(IniFile, AbsentKeysKeepTheirDefaults)
{
	const TAll all = loaded("count = 4\n");
	EXPECT_EQ(all.count, 4);
	EXPECT_EQ(all.radius, 4);
	EXPECT_EQ(CIniFile::fromText("").load<TAll>("Part").title, "a dive");
}

TEST(IniFile, EveryBadValueNamesFileSectionKeyAndProblem)
{
	const struct
	{
		const char *line, *problem;
	} cases[] = {
		{"radius = abc", "[Part] radius = abc: is not a number"},
		{"radius = 1x", "[Part] radius = 1x: is not a number"},
		{"radius = ", "[Part] radius = : is not a number"},
		{"radius = nan", "is not a number"},
		{"radius = inf", "is not a number"},
		{"radius = +-2", "is not a number"},
		{"radius = 1,5", "is not a number"},
		{"radius = 1 # metres", "is not a number"},
		{"radius = 0", "[Part] radius = 0: must be > 0"},
		{"angle = 91", "[Part] angle = 91: must be in [-90, 90]"},
		{"count = 2.5", "[Part] count = 2.5: must be a whole number"},
		{"count = 11", "must be in [1, 10]"},
		{"seed = -1", "[Part] seed = -1: must be in"},
		{"seed = 1.5", "must be a whole number"},
		{"enabled = yes", "[Part] enabled = yes: must be true or false"},
		{"mode = fats", "[Part] mode = fats: did you mean 'fast'?"},
		{"pose = 1 2", "[Part] pose = 1 2: must be 3 numbers"},
		{"pose = 1 2 x", "x: is not a number"},
		{"any = 1 -1", "must be >= 0"},
	};
	for (const auto& c : cases) {
		EXPECT_HOLDS(problemOf(c.line), "run.ini") << c.line;
		EXPECT_HOLDS(problemOf(c.line), c.problem) << c.line;
	}
}

TEST(IniFile, AnUnknownKeyIsRefusedWithTheNearestName)
{
	EXPECT_EQ(problemOf("radus = 1\n"), "run.ini: [Part] unknown key 'radus'; did you mean 'radius'?");
	EXPECT_EQ(problemOf("Radius = 1\n"), "run.ini: [Part] unknown key 'Radius'; did you mean 'radius'?");
}

TEST(IniFile, AnUnknownSectionIsRefused)
{
	EXPECT_EQ(problemOf("[Prat]\nradius = 1\n"), "run.ini: unknown section [Prat]; did you mean 'Part'?");
}

TEST(IniFile, AKeyTwiceAndALineThatIsNoAssignmentAreRefused)
{
	EXPECT_HOLDS(problemOf("radius = 1\ncount = 2\nradius = 3\n"), "run.ini:4: [Part] radius is given twice");
	EXPECT_HOLDS(problemOf("radius 1\n"), "run.ini:2: 'radius 1' is no assignment");
	EXPECT_EQ(problemOf("# comment\n; comment\n// comment, a = b\n\n  radius = 1\r\n"), "");
}

TEST(IniFile, StructsMayShareASection)
{
	CIniFile ini = CIniFile::fromText("[Part]\nradius = 1\ndepth = 5\n", "run.ini");
	EXPECT_EQ(ini.load<TAll>("Part").radius, 1);
	EXPECT_EQ(ini.load<TOther>("Part").depth, 5);
	EXPECT_NO_THROW(ini.refuseUnknown());
	EXPECT_HOLDS(ini.dump(), "depth = 5");
	EXPECT_HOLDS(ini.dump(), "radius = 1");
}

TEST(IniFile, SetWinsOverTheFileAlsoInDottedSections)
{
	CIniFile ini = CIniFile::fromText("[Part]\nradius = 1\n[Sensor.DVL]\ndepth = 1\n", "run.ini");
	ini.set("Part.radius=3");
	ini.set("Sensor.DVL.depth=0.25");
	ini.set(" Other.depth = -1.5 ");
	EXPECT_EQ(ini.load<TAll>("Part").radius, 3);
	EXPECT_EQ(ini.load<TOther>("Sensor.DVL").depth, 0.25);
	EXPECT_EQ(ini.load<TOther>("Other").depth, -1.5);
	EXPECT_NO_THROW(ini.refuseUnknown());
}

TEST(IniFile, SetOfAnUnknownKeyIsRefused)
{
	CIniFile ini = CIniFile::fromText("", "run.ini");
	ini.set("Part.radus=3");
	ini.load<TAll>("Part");
	EXPECT_HOLDS(errorOf<CError>([&] { ini.refuseUnknown(); }), "unknown key 'radus'");
}

TEST(IniFile, SetOfAnotherShapeIsAUsageError)
{
	for (const char* bad : {"radius=1", "Part.radius", "Part.=1", ".radius=1", "", "="}) {
		CIniFile ini = CIniFile::fromText("");
		EXPECT_HOLDS(errorOf<CUsageError>([&] { ini.set(bad); }), "Section.key=value") << bad;
	}
}

TEST(IniFile, DefinesAndEvalWork)
{
	CIniFile ini =
		CIniFile::fromText("@define R 33\n[Part]\nradius = ${R}\ncount = $eval{R - 30}\n", "run.ini");
	const TAll all = ini.load<TAll>("Part");
	EXPECT_EQ(all.radius, 33);
	EXPECT_EQ(all.count, 3);
	EXPECT_NO_THROW(ini.refuseUnknown());
}

TEST(IniFile, ABadDefineIsOneLineThatNamesTheFile)
{
	for (const char* bad : {"radius = ${NOPE}\n", "radius = $eval{2*}\n"}) {
		const std::string problem = problemOf(bad);
		EXPECT_EQ(problem.find("run.ini: "), 0u) << problem;
		EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
	}
}

TEST(IniFile, TheDumpReadsBackToTheSameValues)
{
	TAll all;
	CIniFile ini = CIniFile::fromText(
		"[Part]\nradius = 0.1234567890123456789\nangle = 12.3456789\ncount = 9\nseed = 11\nenabled = false\n"
		"title = x y z\nmode = exact\npose = 0.1 1e-300 -3.3333333333333335\nany = 1 2 3 4\n");
	all = ini.load<TAll>("Part");
	CIniFile again = CIniFile::fromText(ini.dump(), "dump");
	const TAll back = again.load<TAll>("Part");
	again.refuseUnknown();
	EXPECT_EQ(back.radius, all.radius);
	EXPECT_EQ(back.angle, all.angle);
	EXPECT_EQ(back.count, all.count);
	EXPECT_EQ(back.seed, all.seed);
	EXPECT_EQ(back.enabled, all.enabled);
	EXPECT_EQ(back.title, all.title);
	EXPECT_EQ(back.mode, all.mode);
	EXPECT_EQ(back.pose, all.pose);
	EXPECT_EQ(back.any, all.any);
	EXPECT_EQ(again.dump(), ini.dump());
	EXPECT_HOLDS(ini.dump(), "// Radius [m] (must be > 0)");
}

TEST(IniFile, ASectionLoadedTwiceIsDumpedOnceWithTheLastValues)
{
	CIniFile ini = CIniFile::fromText("");
	ini.load<TOther>("Part");
	ini.set("Part.depth=8");
	ini.load<TOther>("Part");
	EXPECT_EQ(ini.dump(), "[Part]\n// Depth [m] (any number)\ndepth = 8\n\n");
}

TEST(IniFile, AMissingFileIsNamed)
{
	CTempFolder folder;
	EXPECT_HOLDS(errorOf<CError>([&] { CIniFile::fromFile(folder / "no.ini"); }), "no.ini: no such file");
	EXPECT_EQ(CIniFile::fromFile(folder.write("a.ini", "[Part]\nradius=2\n")).load<TAll>("Part").radius, 2);
}

TEST(IniFile, AnyAngleOfADumpComesBackToRounding)
{
	for (int i = -200; i <= 200; i++) {
		TAll all;
		all.angle = i * 0.00712345;
		CIniFile ini = CIniFile::fromText("[Part]\nangle = " + listOptions(all)[1].value + "\n");
		EXPECT_NEAR(ini.load<TAll>("Part").angle, all.angle, 4e-16) << "i=" << i;
	}
}
