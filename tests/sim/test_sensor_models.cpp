#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/frames.h>
#include <posidonia/sim/sensor_bank.h>

using namespace posidonia;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
constexpr double kFloor = 6;
constexpr double kTiny = 1e-12;

const CObservationDVL& asDvl(const mrpt::obs::CObservation::Ptr& o)
{
	return dynamic_cast<CObservationDVL&>(*o);
}
TImuReading readingOf(const mrpt::obs::CObservation::Ptr& o)
{
	return imuReadingOf(dynamic_cast<mrpt::obs::CObservationIMU&>(*o)).value();
}
Vector3d velocityOf(const CObservationDVL& dvl)
{
	return {dvl.velocity.x, dvl.velocity.y, dvl.velocity.z};
}

TMotionOptions lively()
{
	TMotionOptions o;
	o.roll = 0.2, o.pitch = 0.15, o.yaw = 0.1, o.heave = 0.2, o.sway = 0.1;
	return o;
}
const CVehicleMotion& livelyMotion()
{
	static const CVehicleMotion motion(TRouteOptions(), lively(), 5);
	return motion;
}

TImuSpec quietImu()
{
	TImuSpec s = TSensorSuite::sparus2().imu.at("IMU");
	s.gyro_noise_density = s.gyro_random_walk = s.accel_noise_density = s.accel_random_walk = 0;
	return s;
}
TDvlSpec quietDvl()
{
	TDvlSpec s = TSensorSuite::sparus2().dvl.at("DVL");
	s.sigma_velocity = 0;
	return s;
}
TSimulatedDvlOptions quietRanges()
{
	TSimulatedDvlOptions o;
	o.sigma_altitude = 0;
	return o;
}
CSimulatedDvl makeQuietDvl(const TCalibrationErrorOptions& errors = {})
{
	return {"DVL", quietDvl(), quietRanges(), errors, kFloor, 1};
}

/** Mean and standard deviation. */
struct TMoments
{
	double mean{0}, sigma{0};
};
TMoments momentsOf(const std::vector<double>& x)
{
	TMoments m;
	for (double v : x)
		m.mean += v / static_cast<double>(x.size());
	for (double v : x)
		m.sigma += (v - m.mean) * (v - m.mean) / static_cast<double>(x.size() - 1);
	m.sigma = std::sqrt(m.sigma);
	return m;
}
/** Within 4.5 standard errors of zero mean and of `sigma`? */
void expectWhite(const std::vector<double>& x, double sigma, const std::string& what)
{
	const double n = static_cast<double>(x.size());
	const TMoments m = momentsOf(x);
	EXPECT_LT(std::abs(m.mean), 4.5 * sigma / std::sqrt(n)) << what;
	EXPECT_NEAR(m.sigma, sigma, 4.5 * sigma / std::sqrt(2 * n)) << what;
}
}  // namespace

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

TEST(SimulatedDvl, OnASpotTurnReadsItsLeverArm)
{
	TVehicleState state;
	state.T_map_body.translation().z() = 3.5;
	state.omega_body = {0, 0, 0.3};
	auto sensor = makeQuietDvl();
	const auto o = sensor.measure(state, 1);
	// 0.4145 m aft of the turning point: 0.3 rad/s to starboard moves it to port, 0.124 m/s
	const Vector3d in_body = quietDvl().T_body_sensor().linear() * velocityOf(asDvl(o));
	EXPECT_LT((in_body - Vector3d(0, -0.3 * 0.4145, 0)).norm(), kTiny);
}

TEST(SimulatedDvl, VelocityIsThatOfTheInstrumentInItsOwnAxes)
{
	auto sensor = makeQuietDvl();
	const Isometry3d T_body_dvl = quietDvl().T_body_sensor();
	const auto pose = [&](double t) -> Isometry3d { return livelyMotion().at(t).T_map_body * T_body_dvl; };
	for (double t = 10; t < 200; t += 7.9) {
		const Vector3d v = pose(t).linear().transpose() *
						   (pose(t + 1e-4).translation() - pose(t - 1e-4).translation()) / 2e-4;
		const auto o = sensor.measure(livelyMotion().at(t), t);
		EXPECT_LT((velocityOf(asDvl(o)) - v).norm(), 1e-7) << "t=" << t;
	}
}

TEST(SimulatedDvl, BeamsHoldTheVelocityAndEndOnTheFloor)
{
	TDvlSpec spec = TSensorSuite::sparus2().dvl.at("DVL");
	CSimulatedDvl sensor("DVL", spec, quietRanges(), {}, kFloor, 1);
	const Eigen::Matrix<double, 3, 4> beams = spec.beams();
	for (double t = 20; t < 100; t += 3) {
		const auto state = livelyMotion().at(t);
		const auto o = sensor.measure(state, t);
		const CObservationDVL& dvl = asDvl(o);
		const Eigen::Map<const Eigen::Vector4d> along(dvl.beam_velocities.data());
		const Vector3d solved = (beams * beams.transpose()).ldlt().solve(beams * along);
		EXPECT_LT((solved - velocityOf(dvl)).norm(), kTiny) << "t=" << t;
		const Isometry3d T_map_dvl = state.T_map_body * spec.T_body_sensor();
		for (int i = 0; i < 4; i++)
			EXPECT_NEAR((T_map_dvl * (dvl.beam_ranges[i] * beams.col(i))).z(), kFloor, 1e-9) << "beam " << i;
		EXPECT_NEAR(dvl.altitude, kFloor - T_map_dvl.translation().z(), kTiny);
	}
}

TEST(SimulatedDvl, NoiseHasTheStatedSigma)
{
	TDvlSpec spec;
	spec.sigma_velocity = 0.02;
	CSimulatedDvl sensor("DVL", spec, TSimulatedDvlOptions(), {}, kFloor, 11);
	std::vector<double> x, z, altitude;
	for (int i = 0; i < 3000; i++) {
		const auto o = sensor.measure(TVehicleState(), i);
		x.push_back(asDvl(o).velocity.x);
		z.push_back(asDvl(o).velocity.z);
		altitude.push_back(asDvl(o).altitude - kFloor);
	}
	expectWhite(x, 0.02, "x");
	expectWhite(z, 0.02, "z");
	expectWhite(altitude, 0.01, "altitude");
}

TEST(SimulatedDvl, LosesTheBottomOutsideItsRange)
{
	auto sensor = makeQuietDvl();
	TVehicleState state;
	state.T_map_body.translation().z() = kFloor - 0.11 - 0.49;
	const auto low = sensor.measure(state, 1);
	EXPECT_FALSE(asDvl(low).velocity_valid || asDvl(low).altitude_valid);
	EXPECT_TRUE(std::isnan(asDvl(low).beam_velocities[2]) && std::isnan(asDvl(low).beam_ranges[2]));
	state.T_map_body.translation().z() -= 0.02;
	const auto high_enough = sensor.measure(state, 2);
	EXPECT_TRUE(asDvl(high_enough).velocity_valid && asDvl(high_enough).altitude_valid);
}

TEST(SimulatedPressure, IsThatOfTheSensorsDepth)
{
	TPressureSpec spec;
	spec.pose = {0.4, 0.1, -0.03, 0, 0, 0};
	spec.sigma = 1e-9;
	CSimulatedPressure sensor("PRESSURE", spec, 1);
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
