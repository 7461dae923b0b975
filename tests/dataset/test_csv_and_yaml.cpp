#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/dataset/csv_reader.h>
#include <posidonia/dataset/sensor_yaml.h>
#include <temp_folder.h>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
std::string yamlProblem(const std::string& text, const std::function<void(const CSensorYaml&)>& use = {})
{
	CTempFolder folder;
	return errorOf<CError>([&] {
		const CSensorYaml yaml(folder.write("sensor.yaml", text));
		if (use) use(yaml);
	});
}
}  // namespace

TEST(SensorYaml, ReadsEurocsFile)
{
	CTempFolder folder;
	const CSensorYaml yaml(folder.write(
		"sensor.yaml",
		"%YAML:1.0\n# comment\nsensor_type: camera\ncomment: \"VI-Sensor\"\n\nT_BS: !!opencv-matrix\n  cols: "
		"4\n  rows: 4\n"
		"  data: [0, -1, 0, 0.5,\n         1, 0, 0, -0.25,\n  0, 0, 1.0, 2e-1,\n 0.0, 0.0, 0.0, "
		"1.0]\nrate_hz: 20 # Hz\n"
		"intrinsics: [1, 2.5, -3, 4]\r\n"));
	EXPECT_EQ(yaml.text("sensor_type"), "camera");
	EXPECT_EQ(yaml.text("comment"), "VI-Sensor");
	EXPECT_EQ(yaml.number("rate_hz"), 20);
	EXPECT_EQ(yaml.numbers("intrinsics", 4), (std::vector<double>{1, 2.5, -3, 4}));
	const Eigen::Isometry3d T = yaml.pose("T_BS");
	EXPECT_LT((T.translation() - Eigen::Vector3d(0.5, -0.25, 0.2)).norm(), 1e-15);
	EXPECT_LT((T.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
	EXPECT_HOLDS(yaml.where("rate_hz"), "sensor.yaml:13");
	EXPECT_EQ(yaml.unknownKeys({"sensor_type", "comment", "T_BS", "rate_hz", "intrinsics"}).size(), 0u);
	const auto unknown = yaml.unknownKeys({"sensor_type", "comment", "T_BS", "rate_h", "intrinsics"});
	ASSERT_EQ(unknown.size(), 1u);
	EXPECT_HOLDS(unknown[0], "sensor.yaml:13: key 'rate_hz' has no effect; did you mean 'rate_h'?");
}

TEST(SensorYaml, EveryErrorNamesFileAndLine)
{
	EXPECT_HOLDS(yamlProblem("a: 1\nrubbish\n"), "sensor.yaml:2: 'rubbish' is no 'key: value'");
	EXPECT_HOLDS(yamlProblem("a: 1\na: 2\n"), "sensor.yaml:2: key 'a' is given twice");
	EXPECT_HOLDS(yamlProblem("a: [1, 2\n 3, 4\n"), "sensor.yaml:1: the list of 'a' has no end");
	EXPECT_HOLDS(yamlProblem("a: 1\n b: 2\n"), "sensor.yaml:2: 'b' is indented below a value");
	EXPECT_HOLDS(
		yamlProblem("a: x\n", [](auto& y) { y.number("a"); }), "sensor.yaml:1: a: 'x' is not a number");
	EXPECT_HOLDS(
		yamlProblem("\na: [1, x]\n", [](auto& y) { y.numbers("a", 2); }),
		"sensor.yaml:2: a: 'x' is not a number");
	EXPECT_HOLDS(
		yamlProblem("a: [1]\n", [](auto& y) { y.numbers("a", 2); }),
		"2 numbers [a, b, ...] was expected, there are 1");
	EXPECT_HOLDS(
		yamlProblem("a: 1\n", [](auto& y) { y.numbers("a", 2); }), "sensor.yaml:1: a: a list of 2 numbers");
	EXPECT_HOLDS(yamlProblem("a: 1\n", [](auto& y) { y.number("b"); }), "sensor.yaml: has no key 'b'");
}

TEST(SensorYaml, APoseMustBeRigid)
{
	const auto pose = [](const CSensorYaml& y) { y.pose("T"); };
	EXPECT_EQ(yamlProblem("T: [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n", pose), "");
	for (const char* bad :
		 {"T: [2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n", "T: [1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]\n",
		  "T: [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1]\n"})
		EXPECT_HOLDS(yamlProblem(bad, pose), "sensor.yaml:1: T is no rigid transformation") << bad;
}

TEST(CsvReader, ReadsRowsAndSkipsBlankLines)
{
	CTempFolder folder;
	CBadRows bad(false);
	CCsvReader csv(folder.write("data.csv", "#t,a,b\n5, 1.5 ,0\r\n\n5,-2e3,1"), {3}, false, bad);
	const auto first = csv.next(), second = csv.next();
	ASSERT_TRUE(first && second);
	EXPECT_EQ(first->stamp, 5);
	EXPECT_EQ(first->line, 2u);
	EXPECT_EQ(first->number(1), 1.5);
	EXPECT_FALSE(first->flag(2));
	EXPECT_EQ(second->line, 4u);
	EXPECT_EQ(second->number(1), -2000);
	EXPECT_TRUE(second->flag(2));
	EXPECT_FALSE(csv.next());
}

TEST(CsvReader, BadRowsAreErrorsOrCounted)
{
	const struct
	{
		const char *row, *problem;
	} cases[] = {
		{"7,1", "data.csv:3: has 2 columns, 3 were expected"},
		{"7,1,2,3", "data.csv:3: has 4 columns"},
		{"x,1,2", "data.csv:3: time stamp 'x' is no integer > 0 [ns]"},
		{"7.5,1,2", "time stamp '7.5' is no integer"},
		{"-7,1,2", "time stamp '-7' is no integer"},
		{"99999999999999999999,1,2", "is no integer"},
		{"4,1,2", "data.csv:3: time stamp 4 goes backwards: the row before has 5"},
	};
	CTempFolder folder;
	for (const auto& c : cases) {
		const std::string path =
			folder.write("data.csv", std::string("#t,a,b\n5,1,2\n") + c.row + "\n9,1,2\n");
		CBadRows strict(false), lenient(true);
		EXPECT_HOLDS(
			errorOf<CError>([&] {
				CCsvReader csv(path, {3}, false, strict);
				while (csv.next())
					continue;
			}),
			c.problem)
			<< c.row;
		CCsvReader csv(path, {3}, false, lenient);
		int rows = 0;
		while (csv.next())
			rows++;
		EXPECT_EQ(rows, 2) << c.row;
		EXPECT_EQ(lenient.count(), 1u) << c.row;
		EXPECT_HOLDS(lenient.messages().at(0), c.problem) << c.row;
	}
}

TEST(CsvReader, FieldsThatAreNoNumbersAreNamedByColumn)
{
	TCsvRow row;
	row.fields = {"1", "abc", "nan", "inf", "2"};
	EXPECT_EQ(errorOf<CRowProblem>([&] { row.number(1); }), "column 2 'abc' is not a number");
	EXPECT_HOLDS(errorOf<CRowProblem>([&] { row.number(2); }), "column 3");
	EXPECT_TRUE(std::isnan(row.numberOrNan(2)));
	EXPECT_HOLDS(errorOf<CRowProblem>([&] { row.numberOrNan(3); }), "column 4");
	EXPECT_HOLDS(errorOf<CRowProblem>([&] { row.flag(4); }), "column 5 '2' must be 0 or 1");
}

TEST(CsvReader, AMissingFileOrHeaderIsAnError)
{
	CTempFolder folder;
	CBadRows lenient(true);
	EXPECT_HOLDS(
		errorOf<CError>([&] { CCsvReader(folder / "no.csv", {3}, false, lenient); }), "no.csv: no such file");
	const std::string path = folder.write("data.csv", "1,2,3\n");
	EXPECT_HOLDS(
		errorOf<CError>([&] { CCsvReader(path, {3}, false, lenient); }), "data.csv:1: is not a header");
}
