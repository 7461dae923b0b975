#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/obs/frames.h>
#include <posidonia/obs/sensor_suite.h>
#include <random_pose.h>
#include <temp_folder.h>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
TSensorSuite readText(const CTempFolder& folder, const std::string& text)
{
	return readSensors(folder.write("dive.sensors.ini", text));
}
}  // namespace

TEST(SensorSuite, RoundTripOfEveryKind)
{
	CTempFolder folder;
	TSensorSuite suite = TSensorSuite::sparus2();
	suite.imu["IMU"].gyro_noise_density = 1.6968e-4;
	suite.ahrs["AHRS"].sigma_heading = 0.0123;
	suite.dvl["DVL"].beam_angle = 0.39;
	suite.dvl["DVL2"].sigma_velocity = 0.02;
	suite.pressure["PRESSURE"].water_density = 1027.5;
	suite.gps["GPS"].sigma_horizontal = 1.25;
	suite.stereo["STEREO"].camera = {1024, 768, 681.186, 680.5, 512.25, 384.75, 0.1234};
	const std::string path = folder / "dive.sensors.ini";
	writeSensors(path, suite);
	const TSensorSuite back = readSensors(path);
	EXPECT_EQ(back.imu.at("IMU").gyro_noise_density, 1.6968e-4);
	EXPECT_EQ(back.imu.at("IMU").pose, suite.imu["IMU"].pose);
	EXPECT_NEAR(back.ahrs.at("AHRS").sigma_heading, 0.0123, 1e-16);
	EXPECT_NEAR(back.dvl.at("DVL").beam_angle, 0.39, 1e-15);
	EXPECT_EQ(back.dvl.at("DVL2").sigma_velocity, 0.02);
	EXPECT_EQ(back.pressure.at("PRESSURE").water_density, 1027.5);
	EXPECT_EQ(back.gps.at("GPS").sigma_horizontal, 1.25);
	EXPECT_EQ(back.stereo.at("STEREO").camera.width, 1024);
	EXPECT_EQ(back.stereo.at("STEREO").camera.cy, 384.75);
	EXPECT_EQ(back.stereo.at("STEREO").camera.baseline, 0.1234);
	writeSensors(folder / "again.sensors.ini", back);
	EXPECT_EQ(fileBytes(folder / "again.sensors.ini"), fileBytes(path));
}

TEST(SensorSuite, EveryBadEntryNamesFileSectionAndKey)
{
	const struct
	{
		const char *text, *problem;
	} cases[] = {
		{"[DVL]\nkind = dvll\n", "[DVL] kind = dvll: did you mean 'dvl'?"},
		{"[DVL]\nrate = 5\n", "[DVL] has no key 'kind'"},
		{"[DVL]\nkind = dvl\nsigma_velocty = 1\n",
		 "[DVL] unknown key 'sigma_velocty'; did you mean 'sigma_velocity'?"},
		{"[DVL]\nkind = dvl\nsigma_velocity = abc\n", "[DVL] sigma_velocity = abc: is not a number"},
		{"[DVL]\nkind = dvl\nsigma_velocity = 0\n", "[DVL] sigma_velocity = 0: must be > 0"},
		{"[DVL]\nkind = dvl\npose = 1 2 3\n", "[DVL] pose = 1 2 3: must be 6 numbers"},
		{"[CAM]\nkind = stereo\nwidth = 640.5\n", "[CAM] width = 640.5: must be a whole number"},
		{"[P]\nkind = pressure\nwater_density = 1\n", "must be in [900, 1100]"},
	};
	CTempFolder folder;
	for (const auto& c : cases) {
		const std::string problem = errorOf<CError>([&] { readText(folder, c.text); });
		EXPECT_HOLDS(problem, "dive.sensors.ini") << c.text;
		EXPECT_HOLDS(problem, c.problem) << c.text;
	}
	EXPECT_HOLDS(errorOf<CError>([&] { readSensors(folder / "no.sensors.ini"); }), "--assume-defaults");
}

TEST(SensorSuite, TheRunOverridesSingleKeys)
{
	TSensorSuite suite = TSensorSuite::sparus2();
	const double rate = suite.dvl["DVL"].rate;
	CIniFile run = CIniFile::fromText("[Sensor.DVL]\nsigma_velocity = 0.02\n", "run.ini");
	run.set("Sensor.PRESSURE.sigma=300");
	overrideSensors(suite, run);
	EXPECT_NO_THROW(run.refuseUnknown());
	EXPECT_EQ(suite.dvl["DVL"].sigma_velocity, 0.02);
	EXPECT_EQ(suite.dvl["DVL"].rate, rate);
	EXPECT_EQ(suite.pressure["PRESSURE"].sigma, 300);
}

TEST(SensorSuite, AnOverrideOfASensorThatIsNotThereIsRefused)
{
	TSensorSuite suite = TSensorSuite::sparus2();
	CIniFile run = CIniFile::fromText("[Sensor.DVX]\nsigma_velocity = 0.02\n", "run.ini");
	overrideSensors(suite, run);
	EXPECT_HOLDS(errorOf<CError>([&] { run.refuseUnknown(); }), "unknown section [Sensor.DVX]");
}

TEST(SensorSuite, ASensorWithoutEntryIsNamedWithTheWayOut)
{
	const TSensorSuite suite = TSensorSuite::sparus2();
	EXPECT_EQ(&specOf(suite.dvl, "DVL"), &suite.dvl.at("DVL"));
	const std::string problem = errorOf<CError>([&] { specOf(suite.dvl, "DVL_AFT"); });
	EXPECT_HOLDS(problem, "sensor 'DVL_AFT': has no entry of kind dvl");
	EXPECT_HOLDS(problem, "--assume-defaults");
}

TEST(SensorSuite, PosesComeBackFromTheirNumbers)
{
	std::mt19937 rng(5);
	for (int i = 0; i < 50; i++) {
		const Eigen::Isometry3d T = randomPose(rng, 2, 1.7);
		TSensorMount mount;
		mount.pose = TSensorMount::poseNumbers(T);
		EXPECT_LT((mount.T_body_sensor().matrix() - T.matrix()).norm(), 1e-12) << "i=" << i;
	}
}

TEST(SensorSuite, DepthAndPressureAreInverse)
{
	const TPressureSpec spec;
	EXPECT_EQ(spec.depth(101325), 0);
	EXPECT_NEAR(spec.pressureAt(10) - spec.pressureAt(0), 1030 * 9.80665 * 10, 1e-6);
	EXPECT_NEAR(spec.depth(spec.pressureAt(3.5)), 3.5, 1e-12);
	EXPECT_NEAR(spec.sigmaDepth(), 0.0099, 1e-4);
}

TEST(SensorSuite, TheSensorsFileStandsBesideTheRawlog)
{
	EXPECT_EQ(sensorsPathOf("/a/dive.rawlog"), "/a/dive.sensors.ini");
	EXPECT_EQ(sensorsPathOf("/a/dive"), "/a/dive.sensors.ini");
}
