#include <gtest/gtest.h>
#include <posidonia/base/error.h>

#include "sample_dataset.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
std::string problemOf(const CSampleDataset& set)
{
	const std::string problem = errorOf<CError>([&] { set.import(); });
	EXPECT_EQ(set.outputs(), std::vector<std::string>()) << "left behind after: " << problem;
	return problem;
}
std::string at(int ms)
{
	return CSampleDataset::stamp(ms);
}
}  // namespace

TEST(ImportErrors, EachBadRowNamesFileAndLineOrIsCounted)
{
	const struct
	{
		const char *file, *header;
		std::string row;
		const char* problem;
	} cases[] = {
		{"imu0/data.csv", "#t\n", at(5) + ",1,2,3,4,5", "imu0/data.csv:2: has 6 columns, 7 were expected"},
		{"imu0/data.csv", "#t\n", at(5) + ",1,2,abc,4,5,6",
		 "imu0/data.csv:2: column 4 'abc' is not a number"},
		{"imu0/data.csv", "#t\n", at(5) + ",1,2,nan,4,5,6",
		 "imu0/data.csv:2: column 4 'nan' is not a number"},
		{"ahrs0/data.csv", "#t\n", at(5) + ",1,1,0,0",
		 "ahrs0/data.csv:2: quaternion in columns 2 to 5 is not of length 1"},
		{"dvl0/data.csv", "#t\n", at(5) + ",1,2,3,2.5,2", "dvl0/data.csv:2: column 6 '2' must be 0 or 1"},
		{"dvl0/data.csv", "#t\n", at(5) + ",1,nan,3,2.5,1", "dvl0/data.csv:2: column 3 'nan'"},
		{"dvl0/data.csv", "#t\n", at(5) + ",1,2,3,2.5,1,1",
		 "dvl0/data.csv:2: has 7 columns, 6 were expected (or 10)"},
		{"pressure0/data.csv", "#t\n", at(5) + ",-3", "pressure0/data.csv:2: pressure must be > 0"},
		{"gps0/data.csv", "#t\n", at(5) + ",95,3,0,1,1", "gps0/data.csv:2: is no latitude and longitude"},
		{"gps0/data.csv", "#t\n", at(5) + ",41,3,0,0,1", "gps0/data.csv:2: sigma_horizontal must be > 0"},
		{"odom0/data.csv", "#t\n", at(5) + ",1,2,3,2,0,0,0", "odom0/data.csv:2: quaternion"},
		{"state_groundtruth_estimate0/data.csv", "#t\n", at(5) + ",1,2,3,1,0,0",
		 "estimate0/data.csv:2: has 7 columns"},
		{"state_groundtruth_estimate0/data.csv", "#t\n", at(5) + ",1,2,x,1,0,0,0",
		 "estimate0/data.csv:2: column 4 'x'"},
		{"pressure0/data.csv", "#t\n1000000000009,101325\n", "1000000000008,101325",
		 "pressure0/data.csv:3: time stamp 1000000000008 goes backwards"},
		{"cam0/data.csv", "#t\n", at(0) + ",none.png", "cam0/data.csv:2: image "},
		{"cam1/data.csv", "#t\n", at(0), "cam1/data.csv:2: has 1 columns"},
		{"cam1/data.csv", "#t\n", at(0) + ",", "cam1/data.csv:2: has no file name"},
	};
	for (const auto& c : cases) {
		const CSampleDataset set;
		set.write(c.file, c.header + c.row + "\n");
		EXPECT_HOLDS(problemOf(set), c.problem) << c.row;
		TDatasetOptions options = set.options();
		options.skip_bad = true;
		const TDatasetReport report = importDataset(options);
		EXPECT_EQ(report.bad_rows, 1u) << c.row;
		EXPECT_HOLDS(report.text(), c.problem) << c.row;
		EXPECT_HOLDS(report.text(), "left out: 1 bad rows") << c.row;
	}
}

TEST(ImportErrors, AnImageOfTheWrongSizeOrKind)
{
	const CSampleDataset set;
	set.writeImage("cam1/data/" + at(300) + ".png", 1, CV_8UC1, {60, 48});
	EXPECT_HOLDS(problemOf(set), "cam1/data.csv:3: image ");
	EXPECT_HOLDS(problemOf(set), "is 60x48, sensor.yaml says 64x48");
	set.write("cam0/data/" + at(600) + ".png", "rubbish");
	TDatasetOptions options = set.options();
	options.skip_bad = true;
	const TDatasetReport report = importDataset(options);
	EXPECT_EQ(report.bad_rows, 2u);
	EXPECT_EQ(report.observations.at("STEREO"), 1u);
	EXPECT_HOLDS(report.text(), "cam0/data.csv:4: image ");
	options.overwrite = true;
	set.writeImage("cam1/data/" + at(300) + ".png", 1, CV_16UC1);
	EXPECT_HOLDS(importDataset(options).text(), "is not of 8 bits");
}

TEST(ImportErrors, YamlsAreNamedWithTheirLine)
{
	const struct
	{
		const char* file;
		std::string text;
		const char* problem;
	} cases[] = {
		{"dvl0/sensor.yaml", "rate_hz: 5\n", "dvl0/sensor.yaml: has no key 'T_BS'"},
		{"dvl0/sensor.yaml", yamlPose("T_BS", CSampleDataset::kIdentity) + "sigma_velocity: 0\n",
		 "dvl0/sensor.yaml:8: sigma_velocity must be > 0"},
		{"dvl0/sensor.yaml", yamlPose("T_BS", "1, 2, 3"),
		 "dvl0/sensor.yaml:4: T_BS.data: a list of 16 numbers"},
		{"imu0/sensor.yaml", yamlPose("T_BS", CSampleDataset::kIdentity) + "rate_hz: fast\n",
		 "imu0/sensor.yaml:8: rate_hz: 'fast' is not a number"},
		{"cam0/sensor.yaml", yamlPose("T_BS", CSampleDataset::kIdentity),
		 "cam0/sensor.yaml: has no key 'resolution'"},
		{"cam0/sensor.yaml", "camera_model: omni\n",
		 "cam0/sensor.yaml:1: camera_model: 'omni' is not supported"},
		{"cam0/sensor.yaml", "distortion_model: equidistant\n",
		 "cam0/sensor.yaml:1: distortion_model: 'equidistant'"},
		{"body.yaml", "world: XYZ\n", "body.yaml:1: world: 'XYZ' is not known"},
	};
	for (const auto& c : cases) {
		const CSampleDataset set;
		set.write(c.file, c.text);
		EXPECT_HOLDS(problemOf(set), c.problem) << c.text;
	}
}

TEST(ImportErrors, AMissingYamlOrTableIsNamed)
{
	for (const char* file :
		 {"dvl0/sensor.yaml", "dvl0/data.csv", "cam0/sensor.yaml", "cam1/data.csv", "odom0/data.csv"})
	{
		const CSampleDataset set;
		set.remove(file);
		EXPECT_HOLDS(problemOf(set), std::string(file) + ": no such file") << file;
	}
}

TEST(ImportErrors, DefaultsAndKeysWithoutEffectAreSaid)
{
	const CSampleDataset set;
	set.write(
		"dvl0/sensor.yaml",
		yamlPose("T_BS", CSampleDataset::kIdentity) + "rate_hz: 5\nbeam_angle_deg: 30\nsigma_velocty: 0.5\n");
	const std::string text = set.import().text();
	EXPECT_HOLDS(text, "dvl0/sensor.yaml: no sigma_velocity, 0.001500 is used");
	EXPECT_HOLDS(text, "key 'sigma_velocty' has no effect; did you mean 'sigma_velocity'?");
}

TEST(ImportErrors, CamerasThatAreNoRig)
{
	const CSampleDataset set;
	const std::string left = fileBytes(set.folder() / "set/mav0/cam0/sensor.yaml"),
					  right = fileBytes(set.folder() / "set/mav0/cam1/sensor.yaml");
	set.write("cam0/sensor.yaml", right);
	set.write("cam1/sensor.yaml", left);
	EXPECT_HOLDS(problemOf(set), "cam1 is not to the right of cam0");
	set.write("cam0/sensor.yaml", left);
	std::string other = right;
	other.replace(other.find("64, 48"), 6, "32, 48");
	set.write("cam1/sensor.yaml", other);
	EXPECT_HOLDS(problemOf(set), "cam0 and cam1 have different resolutions");
}

TEST(ImportErrors, WrongFoldersAndNames)
{
	const CSampleDataset set;
	TDatasetOptions options = set.options();
	const auto problem = [&] { return errorOf<CError>([&] { importDataset(options); }); };
	options.input = set.folder() / "none";
	EXPECT_HOLDS(problem(), "none: no such folder");
	std::filesystem::create_directories(set.folder() / "set/empty");
	options.input = set.folder() / "set/empty";
	EXPECT_HOLDS(problem(), "empty: holds no sensor's folder");
	options = set.options();
	options.output = set.folder() / "dive.log";
	EXPECT_HOLDS(problem(), "must end in .rawlog");
	options = set.options();
	options.input += "/mav0";  // mav0 itself will do
	EXPECT_EQ(problem(), "");
	EXPECT_HOLDS(problem(), "dive.rawlog: exists already; choose another name, or give --overwrite");
	options.overwrite = true;
	EXPECT_EQ(problem(), "");
}

TEST(ImportErrors, LevellingNeedsAnImuAtRest)
{
	const CSampleDataset set;
	TDatasetOptions options = set.options();
	options.level = true;
	const auto problem = [&] { return errorOf<CError>([&] { importDataset(options); }); };
	set.write("imu0/data.csv", "#t\n" + at(0) + ",0,0,0,0,0,9.81\n");
	EXPECT_HOLDS(problem(), "imu0/data.csv: levelling needs the vehicle at rest");
	set.remove("imu0");
	EXPECT_HOLDS(problem(), "levelling needs imu0, which is absent");
}
