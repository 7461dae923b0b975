#include <gtest/gtest.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/frames.h>
#include <posidonia/sim/sensor_bank.h>

#include "sensor_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;

TEST(SimulatedImu, AtRestReadsMinusGravity)
{
	CSimulatedImu imu("IMU", quietImu(), {0, 0}, 1);
	const auto r = readingOf(imu.measure(TVehicleState(), 100));
	EXPECT_LT((r.force - Vector3d(0, 0, -kGravity)).norm(), kTiny);
	EXPECT_LT(r.rate.norm(), kTiny);
}

TEST(SimulatedImu, SpecificForceIsTheAccelerationOfItsOwnPlace)
{
	TImuSpec spec = quietImu();
	spec.pose = {0.8, -0.3, 0.4, 20, -35, 110};
	CSimulatedImu imu("IMU", spec, {0, 0}, 1);
	const Isometry3d T_body_imu = spec.T_body_sensor();
	const auto place = [&](double t) -> Vector3d {
		return livelyMotion().at(t).T_map_body * T_body_imu.translation();
	};
	const double h = 1e-3;
	for (double t = 3; t < 100; t += 4.3) {
		const auto state = livelyMotion().at(t);
		const Eigen::Matrix3d R_imu_map = (state.T_map_body * T_body_imu).linear().transpose();
		const Vector3d a = (place(t + h) - 2 * place(t) + place(t - h)) / (h * h);
		const auto r = readingOf(imu.measure(state, t));
		EXPECT_LT((r.force - R_imu_map * (a - Vector3d(0, 0, kGravity))).norm(), 1e-5) << "t=" << t;
		EXPECT_LT((r.rate - T_body_imu.linear().transpose() * state.omega_body).norm(), kTiny) << "t=" << t;
	}
}

TEST(SimulatedImu, WhiteNoiseHasTheDensityTimesRootRate)
{
	TImuSpec spec = quietImu();
	spec.gyro_noise_density = 1e-3, spec.accel_noise_density = 2e-2, spec.rate = 25;
	CSimulatedImu imu("IMU", spec, {0, 0}, 7);
	std::vector<double> gyro, accel;
	for (int i = 0; i < 4000; i++) {
		const auto r = readingOf(imu.measure(TVehicleState(), i));
		gyro.push_back(r.rate.y());
		accel.push_back(r.force.z() + kGravity);
	}
	expectWhite(gyro, 5e-3, "gyro");
	expectWhite(accel, 0.1, "accelerometer");
}

TEST(SimulatedImu, BiasStartsAndWalksAsStated)
{
	TImuSpec spec = quietImu();
	spec.gyro_random_walk = 1e-4, spec.rate = 10;
	std::vector<double> start, walked;
	for (unsigned seed = 1; seed <= 800; seed++) {
		CSimulatedImu imu("IMU", spec, {0.01, 0.05}, seed);
		TImuReading first = readingOf(imu.measure(TVehicleState(), 0)), last = first;
		for (int i = 1; i <= 100; i++)
			last = readingOf(imu.measure(TVehicleState(), i * 0.1));
		start.push_back(first.rate.x());
		walked.push_back(last.rate.x() - first.rate.x());
	}
	expectWhite(start, 0.01, "turn-on bias");
	expectWhite(walked, 1e-4 * std::sqrt(10.0), "walk over 10 s");
}

TEST(SimulatedAhrs, HeadingHasItsBiasAndNoise)
{
	TAhrsSpec spec;
	spec.pose = {0, 0, 0, 90, 0, 180};
	CSimulatedAhrs ahrs("AHRS", spec, {0.1}, 3);
	std::vector<double> heading, pitch;
	const auto state = livelyMotion().at(33);
	const Vector3d truth = yawPitchRoll(state.T_map_body.linear());
	for (int i = 0; i < 3000; i++) {
		const auto o = ahrs.measure(state, i);
		const auto R = attitudeOf(dynamic_cast<mrpt::obs::CObservationIMU&>(*o)).value();
		const Vector3d ypr = yawPitchRoll(R * spec.T_body_sensor().linear().transpose());
		heading.push_back(wrapAngle(ypr[0] - truth[0] - 0.1));
		pitch.push_back(ypr[1] - truth[1]);
	}
	expectWhite(heading, spec.sigma_heading, "heading");
	expectWhite(pitch, spec.sigma_roll_pitch, "pitch");
}

TEST(SimulatedPressure, IsThatOfTheSensorsDepth)
{
	TPressureSpec spec;
	spec.pose = {0.4, 0.1, -0.03, 0, 0, 0};
	spec.sigma = 1e-9;
	CSimulatedPressure sensor("PRESSURE", spec, {}, 1);
	const auto state = livelyMotion().at(50);
	const auto o = sensor.measure(state, 50);
	const double depth = spec.depth(dynamic_cast<CObservationPressure&>(*o).pressure);
	EXPECT_NEAR(depth, (state.T_map_body * Vector3d(0.4, 0.1, -0.03)).z(), 1e-9);
}

TEST(SimulatedGps, FixesOnlyNearTheSurfaceAndAtTheAntenna)
{
	TGpsSpec spec;
	spec.pose = {-0.39, 0, -0.36, 0, 0, 0};
	const TWorldOptions datum;
	CSimulatedGps gps("GPS", spec, TSimulatedGpsOptions(), datum, 1);
	TVehicleState state;
	state.T_map_body.translation() << 30, -40, 1.001;
	EXPECT_FALSE(gps.measure(state, 1420070400));
	state.T_map_body.translation().z() = 0.999;
	std::vector<double> north, east;
	for (int i = 0; i < 2000; i++) {
		const auto o =
			std::dynamic_pointer_cast<mrpt::obs::CObservationGPS>(gps.measure(state, 1420070400 + i));
		ASSERT_TRUE(o && o->has_GGA_datum());
		const auto& f = o->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
		EXPECT_EQ(f.fix_quality, 1);
		EXPECT_TRUE(f.thereis_HDOP);
		const Vector3d ned =
			nedFromGeodetic({f.latitude_degrees, f.longitude_degrees, f.altitude_meters}, datum);
		north.push_back(ned.x() - 30 + 0.39);
		east.push_back(ned.y() + 40);
	}
	expectWhite(north, spec.sigma_horizontal, "north");
	expectWhite(east, spec.sigma_horizontal, "east");
}

TEST(CalibrationError, DvlScaleAndMountingActOnTheVelocity)
{
	TCalibrationErrorOptions errors;
	errors.dvl_scale = 0.01, errors.dvl_yaw = 0.02;
	auto sensor = makeQuietDvl(errors);
	TVehicleState state;
	state.v_body = {0.5, 0, 0};
	const auto o = sensor.measure(state, 1);
	// Who believes the nominal mounting sees the vehicle go to port of where it goes.
	const Vector3d believed = quietDvl().T_body_sensor().linear() * velocityOf(asDvl(o));
	EXPECT_LT((believed - 1.01 * 0.5 * Vector3d(std::cos(0.02), -std::sin(0.02), 0)).norm(), kTiny);
	EXPECT_LT((fromMrpt(asDvl(o).sensorPose).matrix() - quietDvl().T_body_sensor().matrix()).norm(), 1e-9);
}

TEST(CalibrationError, SignsAreDrawnAndSizesStay)
{
	TCalibrationErrorOptions errors;
	errors.focal_length = 0.01, errors.baseline = 0.02, errors.camera_yaw = 0.03, errors.dvl_scale = 0.04;
	EXPECT_EQ(drawnSigns(errors, 1).baseline, 0.02);
	errors.random_signs = true;
	int negative = 0;
	for (unsigned seed = 0; seed < 200; seed++) {
		const auto drawn = drawnSigns(errors, seed);
		EXPECT_EQ(std::abs(drawn.focal_length), 0.01);
		EXPECT_EQ(std::abs(drawn.camera_yaw), 0.03);
		EXPECT_EQ(std::abs(drawn.dvl_scale), 0.04);
		negative += drawn.baseline < 0;
	}
	EXPECT_NEAR(negative, 100, 32);	 // 4.5 sigma
}

TEST(SensorBank, GivesEverySensorAtItsRateInOrder)
{
	TSimulationOptions options;
	CSensorBank bank(options, TSensorSuite::sparus2());
	std::map<std::string, int> count;
	double previous = 0;
	for (double t = bank.nextTime(); t < 9.999; t = bank.nextTime()) {
		EXPECT_GE(t, previous);
		previous = t;
		const auto o = bank.measure(TVehicleState());
		ASSERT_TRUE(o);
		EXPECT_EQ(stampOf(*o), options.run.start_time + t);
		count[o->sensorLabel]++;
	}
	const std::map<std::string, int> expected{{"IMU", 500},		{"AHRS", 200}, {"DVL", 50},
											  {"PRESSURE", 50}, {"GPS", 10},   {"STEREO", 30}};
	EXPECT_EQ(count, expected);
}

TEST(SensorBank, SwitchingOneSensorOffLeavesTheOthersAlone)
{
	const auto gyros = [](bool with_dvl) {
		TSimulationOptions options;
		options.run.dvl = with_dvl;
		CSensorBank bank(options, TSensorSuite::sparus2());
		std::vector<double> x;
		while (bank.nextTime() < 3) {
			const auto o = bank.measure(TVehicleState());
			EXPECT_TRUE(with_dvl || o->sensorLabel != "DVL");
			if (o->sensorLabel == "IMU") x.push_back(readingOf(o).rate.x());
		}
		return x;
	};
	EXPECT_EQ(gyros(true), gyros(false));
}
