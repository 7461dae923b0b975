#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <posidonia/obs/frames.h>
#include <posidonia/sim/sensor_bank.h>

#include "sensor_test_tools.h"

/** Which random number goes where is part of a log's meaning: an old seed must give its old log, and a new
 * feature that is off must draw nothing from an old generator. These tests draw the numbers once more. */
using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
constexpr double kStart = 1420070400;
constexpr unsigned kSeed = 5;
constexpr int kReadings = 300;

Vector3d draw3(CNoise& noise)
{
	const double x = noise.normal(), y = noise.normal(), z = noise.normal();
	return {x, y, z};
}
std::string bytesOf(const mrpt::obs::CObservation& o)
{
	mrpt::io::CMemoryStream memory;
	mrpt::serialization::archiveFrom(memory) << o;
	return {
		static_cast<const char*>(memory.getRawBufferData()),
		static_cast<size_t>(memory.getTotalBytesCount())};
}
TVehicleState stateAt(int i)
{
	return livelyMotion().at(0.2 * i);
}
/** Every feature that draws numbers of its own, on. */
TSimulationOptions everythingOn()
{
	TSimulationOptions o;
	o.run.stereo = false;
	o.dvl.random_scale = true, o.dvl.outlier_rate = 0.1, o.dvl.beam_loss = 0.1;
	o.dvl.lock_loss_start = 20, o.dvl.lock_loss_duration = 2;
	o.pressure.tide_amplitude = 1;
	return o;
}
TSensorSuite everythingWanders()
{
	TSensorSuite s = TSensorSuite::sparus2();
	s.ahrs.at("AHRS").sigma_tilt_bias = 0.01, s.ahrs.at("AHRS").sigma_heading_bias = 0.02;
	s.gps.at("GPS").sigma_bias = 2;
	s.pressure.at("PRESSURE").sigma_offset = 100, s.pressure.at("PRESSURE").offset_walk = 1;
	return s;
}
/** Bytes of 40 s of log, observation by observation. */
std::vector<std::string> logOf(const TSimulationOptions& options, const TSensorSuite& suite)
{
	CSensorBank bank(options, suite);
	std::vector<std::string> log;
	while (bank.nextTime() < 40)
		if (const auto o = bank.measure(livelyMotion().at(bank.nextTime()))) log.push_back(bytesOf(*o));
	return log;
}
}  // namespace

TEST(RandomStream, OfTheImu)
{
	const TImuSpec spec = TSensorSuite::sparus2().imu.at("IMU");
	const TSimulatedImuOptions options;
	CSimulatedImu imu("IMU", spec, options, kSeed);
	CNoise noise(seedOf(kSeed, "IMU"));
	Vector3d gyro = options.gyro_bias * draw3(noise), accel = options.accel_bias * draw3(noise);
	const double white = std::sqrt(spec.rate), step = 1 / white;
	for (int i = 0; i < kReadings; i++) {
		TImuReading r = trueImuReading(stateAt(i), spec.T_body_sensor());
		r.rate += gyro + spec.gyro_noise_density * white * draw3(noise);
		r.force += accel + spec.accel_noise_density * white * draw3(noise);
		const auto expected = makeImu("IMU", kStart + i, spec.T_body_sensor(), r);
		EXPECT_EQ(bytesOf(*imu.measure(stateAt(i), kStart + i)), bytesOf(*expected)) << i;
		EXPECT_EQ(imu.gyroBias(), gyro) << i;
		EXPECT_EQ(imu.accelBias(), accel) << i;
		gyro += spec.gyro_random_walk * step * draw3(noise);
		accel += spec.accel_random_walk * step * draw3(noise);
	}
}

TEST(RandomStream, OfTheAhrs)
{
	const TAhrsSpec spec = TSensorSuite::sparus2().ahrs.at("AHRS");
	CSimulatedAhrs ahrs("AHRS", spec, {0.1}, kSeed);
	CNoise noise(seedOf(kSeed, "AHRS"));
	for (int i = 0; i < kReadings; i++) {
		const Vector3d ypr = yawPitchRoll(stateAt(i).T_map_body.linear()), n = draw3(noise);
		const Eigen::Matrix3d R = rotationFromYawPitchRoll(
			ypr[0] + 0.1 + spec.sigma_heading * n[0], ypr[1] + spec.sigma_roll_pitch * n[1],
			ypr[2] + spec.sigma_roll_pitch * n[2]);
		const auto expected =
			makeAhrs("AHRS", kStart + i, spec.T_body_sensor(), R * spec.T_body_sensor().linear());
		EXPECT_EQ(bytesOf(*ahrs.measure(stateAt(i), kStart + i)), bytesOf(*expected)) << i;
	}
}

TEST(RandomStream, OfTheDvl)
{
	const TDvlSpec spec = TSensorSuite::sparus2().dvl.at("DVL");
	TCalibrationErrorOptions errors;
	errors.dvl_scale = 0.01;
	CSimulatedDvl sensor("DVL", spec, {}, errors, flatFloor(), kSeed);
	CNoise noise(seedOf(kSeed, "DVL"));
	const Isometry3d T_body_dvl = spec.T_body_sensor();
	for (int i = 0; i < kReadings; i++) {
		const auto s = stateAt(i);
		const Vector3d truth =
			T_body_dvl.linear().transpose() * (s.v_body + s.omega_body.cross(T_body_dvl.translation()));
		const Vector3d n = draw3(noise);
		noise.normal();	 // error velocity
		const auto o = sensor.measure(s, kStart + i);
		EXPECT_EQ(asDvl(o).velocity.x, 1.01 * truth.x() + spec.sigma_velocity * n.x()) << i;
		EXPECT_EQ(asDvl(o).velocity.y, 1.01 * truth.y() + spec.sigma_velocity * n.y()) << i;
		EXPECT_EQ(asDvl(o).velocity.z, 1.01 * truth.z() + spec.sigmaAlong() * n.z()) << i;
		for (int k = 0; k < 4; k++)
			noise.normal();	 // ranges
		const double altitude = kFloor - (s.T_map_body * T_body_dvl.translation()).z();
		EXPECT_EQ(asDvl(o).altitude, altitude + TSimulatedDvlOptions().sigma_altitude * noise.normal()) << i;
	}
}

TEST(RandomStream, OfPressureAndGps)
{
	const TSensorSuite suite = TSensorSuite::sparus2();
	const TPressureSpec depth_spec = suite.pressure.at("PRESSURE");
	const TGpsSpec gps_spec = suite.gps.at("GPS");
	CSimulatedPressure pressure("PRESSURE", depth_spec, {}, kSeed);
	CSimulatedGps gps("GPS", gps_spec, {}, {}, kSeed);
	CNoise depth_noise(seedOf(kSeed, "PRESSURE")), gps_noise(seedOf(kSeed, "GPS"));
	const TVehicleState state;
	for (int i = 0; i < kReadings; i++) {
		const auto p = pressure.measure(state, kStart + i);
		EXPECT_EQ(
			dynamic_cast<CObservationPressure&>(*p).pressure,
			depth_spec.pressureAt(depth_spec.pose[2]) + depth_spec.sigma * depth_noise.normal())
			<< i;
		const double north = gps_noise.normal(), east = gps_noise.normal();
		const Vector3d antenna = gps_spec.T_body_sensor().translation();
		const TGeodetic fix =
			geodeticFromNed(antenna + gps_spec.sigma_horizontal * Vector3d(north, east, 0), {});
		const auto o = gps.measure(state, kStart + i);
		const auto& gga = dynamic_cast<mrpt::obs::CObservationGPS&>(*o)
							  .getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>()
							  .fields;
		EXPECT_EQ(gga.latitude_degrees, fix.latitude) << i;
		EXPECT_EQ(gga.longitude_degrees, fix.longitude) << i;
	}
}

TEST(RandomStream, SameSeedSameBytesWithEverythingOn)
{
	TSimulationOptions options = everythingOn();
	const auto log = logOf(options, everythingWanders());
	EXPECT_GT(log.size(), 3000u);
	EXPECT_EQ(log, logOf(options, everythingWanders()));
	options.run.seed++;
	EXPECT_NE(log, logOf(options, everythingWanders()));
}

TEST(SimulatedOptions, DefaultsAddNoError)
{
	const TSimulatedDvlOptions dvl;
	EXPECT_FALSE(dvl.random_scale);
	EXPECT_EQ(dvl.outlier_rate, 0);
	EXPECT_EQ(dvl.outlier_speed, 1.5);
	EXPECT_EQ(dvl.beam_loss, 0);
	EXPECT_EQ(dvl.max_slant_range, 81);
	EXPECT_EQ(dvl.lock_loss_duration, 0);
	EXPECT_EQ(TSimulatedPressureOptions().tide_amplitude, 0);
	EXPECT_NEAR(TSimulatedPressureOptions().tide_period, 12.42 * 3600, 5);
}

TEST(SimulatedOptions, EachNewKeyLoadsFromItsSection)
{
	CIniFile ini = CIniFile::fromText(
		"[SimulatedDvl]\nrandom_scale = true\noutlier_rate = 0.01\noutlier_speed = 2\nbeam_loss = 0.02\n"
		"max_slant_range = 60\nlock_loss_start = 100\nlock_loss_duration = 30\n"
		"[SimulatedPressure]\ntide_amplitude = 0.3\ntide_period = 3600\n");
	TSimulationOptions o;
	o.forEachSection([&](const char* section, auto& options) { ini.loadOnto(options, section); });
	ini.refuseUnknown();
	EXPECT_TRUE(o.dvl.random_scale);
	EXPECT_EQ(o.dvl.outlier_rate, 0.01);
	EXPECT_EQ(o.dvl.outlier_speed, 2);
	EXPECT_EQ(o.dvl.beam_loss, 0.02);
	EXPECT_EQ(o.dvl.max_slant_range, 60);
	EXPECT_EQ(o.dvl.lock_loss_start, 100);
	EXPECT_EQ(o.dvl.lock_loss_duration, 30);
	EXPECT_EQ(o.pressure.tide_amplitude, 0.3);
	EXPECT_EQ(o.pressure.tide_period, 3600);
}
