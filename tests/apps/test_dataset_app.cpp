#include <posidonia/apps/CDatasetApp.h>

#include "../dataset/sample_dataset.h"
#include "../dataset/sample_dvl_gt.h"
#include "apps_testing.h"

namespace fs = std::filesystem;
using namespace posidonia;
using namespace posidonia::testing;

namespace
{
TDatasetReport convert(const CSampleDataset& set, std::vector<std::string> more = {})
{
	CDatasetApp app;
	more.insert(more.begin(), {"-i", set.folder() / "set", "-o", set.folder() / "out/dive.rawlog"});
	runApp(app, more);
	return app.results();
}
}  // namespace

TEST(DatasetApp, WritesARawlogWithPicturesAndSensors)
{
	const CSampleDataset set;
	const TDatasetReport report = convert(set);
	std::map<std::string, size_t> counts;
	CRawlogReader reader(set.folder() / "out/dive.rawlog");
	const CStereoImageLoader loader(reader.path());
	while (const auto o = reader.next()) {
		counts[o->sensorLabel]++;
		if (const auto* pair = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(o.get())) {
			EXPECT_FALSE(loader.load(*pair).right.empty());
		}
	}
	EXPECT_EQ(counts, report.observations);
	EXPECT_EQ(counts.at("IMU"), 20u);
	EXPECT_EQ(counts.at("STEREO"), 3u);
	EXPECT_EQ(readSensors(set.folder() / "out/dive.sensors.ini").imu.count("IMU"), 1u);
	EXPECT_EQ(readTum(set.folder() / "out/dive.gt.tum").size(), report.ground_truth_poses);
	EXPECT_EQ(report.datum_source, "body.yaml");
}

TEST(DatasetApp, OverwritesOnlyWhenTold)
{
	const CSampleDataset set;
	convert(set);
	EXPECT_HOLDS(errorOf<CError>([&] { convert(set); }), "exists already");
	EXPECT_EQ(convert(set, {"--overwrite"}).observations.at("IMU"), 20u);
}

TEST(DatasetApp, SkipsBadRowsOnlyWhenTold)
{
	const CSampleDataset set;
	set.write(
		"pressure0/data.csv",
		"#timestamp [ns],pressure [Pa]\n" + set.stamp(130) + ",123456.5\n" + set.stamp(330) + ",deep\n");
	const std::string error = errorOf<CError>([&] { convert(set); });
	EXPECT_HOLDS(error, "pressure0/data.csv:3");
	EXPECT_FALSE(fs::exists(set.folder() / "out/dive.rawlog"));
	const TDatasetReport report = convert(set, {"--skip-bad"});
	EXPECT_EQ(report.bad_rows, 1u);
	EXPECT_EQ(report.observations.at("PRESSURE"), 1u);
}

TEST(DatasetApp, DatumOfTheIniCountsWhereTheSetHasNone)
{
	const CSampleDataset set;
	set.write(
		"body.yaml", "%YAML:1.0\nworld: NWU\n" +
						 yamlPose("T_FRD_body", "1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1"));
	EXPECT_EQ(convert(set).datum_source, "first fix");
	const TDatasetReport report =
		convert(set, {"--overwrite", "--set", "World.latitude=41.25", "--set", "World.longitude=3.5"});
	EXPECT_EQ(report.datum_source, "ini");
	EXPECT_DOUBLE_EQ(report.datum->latitude, 41.25);
	EXPECT_DOUBLE_EQ(report.datum->longitude, 3.5);
}

TEST(DatasetApp, LevelAndCubicAreHandedOn)
{
	const CSampleDataset set;
	EXPECT_FALSE(convert(set).levelled);
	EXPECT_TRUE(convert(set, {"--overwrite", "--level"}).levelled);
	CDatasetApp app;
	const std::string in = set.folder() / "set", out = set.folder() / "c.rawlog";
	runApp(app, {"-i", in, "-o", out, "--cubic"});
	EXPECT_TRUE(app.params.cubic);
}

TEST(DatasetApp, TablesOfDvlAndTruthWithAttitudeErrors)
{
	const CSampleDvlGt log;
	CDatasetApp app;
	runApp(
		app,
		{"--format", "dvl-gt-csv", "-i", log.folder / "log", "-o", log.folder / "out/dive.rawlog",
		 "--attitude-noise", "0.5", "--attitude-bias", "1", "--attitude-bias-time", "300", "--seed", "7"});
	EXPECT_EQ(app.results().observations.at("DVL"), 60u);
	EXPECT_EQ(app.results().datum_source, "first row");
	EXPECT_NEAR(app.params.attitude_errors.noise, 0.5 * M_PI / 180, 1e-15);
	EXPECT_NEAR(app.params.attitude_errors.bias, M_PI / 180, 1e-15);
	EXPECT_EQ(app.params.attitude_errors.bias_time, 300);
	EXPECT_EQ(app.params.attitude_errors.seed, 7u);
	const TAhrsSpec ahrs = readSensors(log.folder / "out/dive.sensors.ini").ahrs.at("AHRS");
	EXPECT_NEAR(ahrs.sigma_heading, 0.5 * M_PI / 180, 1e-12);
	EXPECT_NEAR(ahrs.sigma_heading_bias, M_PI / 180, 1e-12);
	EXPECT_EQ(ahrs.bias_time, 300);
	EXPECT_EQ(readTum(log.folder / "out/dive.gt.tum").size(), 60u);
}

TEST(DatasetApp, FlagsOfTheOtherFormatAreRefused)
{
	const CSampleDvlGt log;
	const struct
	{
		std::vector<std::string> flags;
		const char* problem;
	} cases[] = {
		{{"--format", "csv"}, "csv"},
		{{"--attitude-noise", "0.5"}, "--attitude-noise: has no effect without --format dvl-gt-csv"},
		{{"--attitude-bias", "0.5"}, "--attitude-bias: has no effect without --format dvl-gt-csv"},
		{{"--format", "dvl-gt-csv", "--level"}, "--level: has no effect with --format dvl-gt-csv"},
		{{"--format", "dvl-gt-csv", "--cubic"}, "--cubic: has no effect with --format dvl-gt-csv"},
		{{"--format", "dvl-gt-csv", "--attitude-noise", "-1"}, "--attitude-noise: must be >= 0"},
		{{"--format", "dvl-gt-csv", "--attitude-bias", "nan"}, "attitude-bias"},
		{{"--format", "dvl-gt-csv", "--attitude-bias", "1", "--attitude-bias-time", "0"},
		 "--attitude-bias-time: must be > 0"},
		{{"--format", "dvl-gt-csv", "--attitude-bias-time", "60"},
		 "--attitude-bias-time: has no effect without --attitude-bias"},
		{{"--format", "dvl-gt-csv", "--seed", "3"}, "--seed: has no effect without --attitude-noise or"}};
	for (const auto& c : cases) {
		CDatasetApp app;
		std::vector<std::string> args{"-i", log.folder / "log", "-o", log.folder / "dive.rawlog"};
		args.insert(args.end(), c.flags.begin(), c.flags.end());
		EXPECT_HOLDS(errorOf<CUsageError>([&] { runApp(app, args); }), c.problem) << c.problem;
		EXPECT_FALSE(fs::exists(log.folder / "dive.rawlog")) << c.problem;
	}
}
