#include <gtest/gtest.h>
#include <posidonia/obs/frames.h>
#include <posidonia/sim/sensor_bank.h>

#include "sensor_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
constexpr double kStart = 1420070400;
constexpr unsigned kSeeds = 2000;

Eigen::Matrix3d attitudeIn(const mrpt::obs::CObservation::Ptr& o)
{
	return attitudeOf(dynamic_cast<mrpt::obs::CObservationIMU&>(*o)).value();
}
double pressureIn(const mrpt::obs::CObservation::Ptr& o)
{
	return dynamic_cast<CObservationPressure&>(*o).pressure;
}
Vector3d fixIn(const mrpt::obs::CObservation::Ptr& o)
{
	const auto& gps = dynamic_cast<mrpt::obs::CObservationGPS&>(*o);
	const auto& f = gps.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
	return nedFromGeodetic({f.latitude_degrees, f.longitude_degrees, f.altitude_meters}, TWorldOptions());
}
TAhrsSpec wanderingAhrs()
{
	TAhrsSpec spec;
	spec.sigma_tilt_bias = 0.01, spec.sigma_heading_bias = 0.03, spec.bias_time = 2;
	return spec;
}
TGpsSpec wanderingGps()
{
	TGpsSpec spec;
	spec.sigma_bias = 1.5, spec.bias_time = 20;
	return spec;
}
TPressureSpec wanderingPressure()
{
	TPressureSpec spec;
	spec.sigma_offset = 300, spec.offset_walk = 4;
	return spec;
}

/** A wandering error's channel at the first reading and `later` readings on, over the seeds. */
struct TPairs
{
	std::vector<double> first, later;
};
/** Stationary with `sigma`, and correlated by exp(-lag / time)? */
void expectGaussMarkov(const TPairs& x, double sigma, double lag_over_time, const std::string& what)
{
	expectWhite(x.first, sigma, what + " at the start");
	expectWhite(x.later, sigma, what + " later");
	expectCorrelation(x.first, x.later, std::exp(-lag_over_time), what + " start to later");
}
}  // namespace

TEST(GaussMarkov, IsStationaryWithItsCorrelationTimeWhateverTheStep)
{
	for (const int steps : {1, 5, 20}) {
		const double time = 4, lag = 3;
		TPairs a, b;
		for (unsigned seed = 1; seed <= kSeeds; seed++) {
			CGaussMarkov<2> process({0.5, 2}, time, lag / steps, seed);
			a.first.push_back(process.value()[0]), b.first.push_back(process.value()[1]);
			for (int i = 0; i < steps; i++)
				process.advance();
			a.later.push_back(process.value()[0]), b.later.push_back(process.value()[1]);
		}
		const std::string what = std::to_string(steps) + " steps";
		expectGaussMarkov(a, 0.5, lag / time, what + ", first channel");
		expectGaussMarkov(b, 2, lag / time, what + ", second channel");
		expectCorrelation(a.later, b.later, 0, what + ", between the channels");
	}
}

TEST(GaussMarkov, StepsAreWhiteWithTheExactDrive)
{
	const double sigma = 0.3, time = 600, step = 0.05, phi = std::exp(-step / time);
	CGaussMarkov<1> process(Eigen::Matrix<double, 1, 1>(sigma), time, step, 9);
	std::vector<double> drive, next;
	for (int i = 0; i < 20000; i++) {
		const double before = process.value()[0];
		process.advance();
		drive.push_back(process.value()[0] - phi * before);
	}
	expectWhite(drive, sigma * std::sqrt(1 - phi * phi), "drive");
	next.assign(drive.begin() + 1, drive.end());
	drive.pop_back();
	expectCorrelation(drive, next, 0, "drive to the next one");
}

TEST(SimulatedAhrs, WanderTurnsTheAttitudeAboutTheMapAxes)
{
	TAhrsSpec quiet;
	quiet.pose = {0, 0, 0, 90, 20, 180};
	TAhrsSpec spec = wanderingAhrs();
	spec.pose = quiet.pose;
	CSimulatedAhrs with("AHRS", spec, {0.1}, 3), without("AHRS", quiet, {0.1}, 3);
	Vector3d previous = 1e3 * Vector3d::Ones();
	for (int i = 0; i < 200; i++) {
		const auto state = livelyMotion().at(0.05 * i + 30);
		const auto R = attitudeIn(with.measure(state, kStart)),
				   R_quiet = attitudeIn(without.measure(state, kStart));
		EXPECT_LT((R - expSO3(with.error()) * R_quiet).norm(), 1e-9) << i;
		EXPECT_NE(with.error(), previous) << i;
		previous = with.error();
	}
	EXPECT_EQ(without.error(), Vector3d(0, 0, 0));
}

TEST(SimulatedAhrs, WanderIsGaussMarkovOfTheSpec)
{
	const TAhrsSpec spec = wanderingAhrs();
	std::array<TPairs, 3> axes;
	const int readings = 20;  // 1 s
	for (unsigned seed = 1; seed <= kSeeds; seed++) {
		CSimulatedAhrs ahrs("AHRS", spec, {}, seed);
		ahrs.measure(TVehicleState(), kStart);
		for (size_t k = 0; k < 3; k++)
			axes[k].first.push_back(ahrs.error()[k]);
		for (int i = 1; i <= readings; i++)
			ahrs.measure(TVehicleState(), kStart + i / spec.rate);
		for (size_t k = 0; k < 3; k++)
			axes[k].later.push_back(ahrs.error()[k]);
	}
	const double lag = readings / spec.rate / spec.bias_time;
	expectGaussMarkov(axes[0], spec.sigma_tilt_bias, lag, "about north");
	expectGaussMarkov(axes[1], spec.sigma_tilt_bias, lag, "about east");
	expectGaussMarkov(axes[2], spec.sigma_heading_bias, lag, "about down");
}

TEST(SimulatedGps, BiasAddsToTheFix)
{
	CSimulatedGps with("GPS", wanderingGps(), {}, {}, 2), without("GPS", TGpsSpec(), {}, {}, 2);
	for (int i = 0; i < 100; i++) {
		const Vector3d error = fixIn(with.measure(TVehicleState(), kStart + i)) -
							   fixIn(without.measure(TVehicleState(), kStart + i));
		EXPECT_LT((error.head<2>() - with.bias()).norm(), 1e-6) << i;
		EXPECT_NEAR(error.z(), 0, 1e-5) << i;
		EXPECT_GT(with.bias().norm(), 0) << i;
	}
	EXPECT_EQ(without.bias(), Vector2d(0, 0));
}

TEST(SimulatedGps, BiasIsGaussMarkovOfTheSpec)
{
	const TGpsSpec spec = wanderingGps();
	TPairs north, east;
	for (unsigned seed = 1; seed <= kSeeds; seed++) {
		CSimulatedGps gps("GPS", spec, {}, {}, seed);
		gps.measure(TVehicleState(), kStart);
		north.first.push_back(gps.bias().x()), east.first.push_back(gps.bias().y());
		for (int i = 1; i <= 10; i++)
			gps.measure(TVehicleState(), kStart + i);
		north.later.push_back(gps.bias().x()), east.later.push_back(gps.bias().y());
	}
	expectGaussMarkov(north, spec.sigma_bias, 10 / spec.bias_time, "north");
	expectGaussMarkov(east, spec.sigma_bias, 10 / spec.bias_time, "east");
	expectCorrelation(north.later, east.later, 0, "north and east");
}

TEST(SimulatedGps, FixesDoNotDependOnWhetherTheVehicleDived)
{
	CSimulatedGps dived("GPS", wanderingGps(), {}, {}, 2), stayed("GPS", wanderingGps(), {}, {}, 2);
	TVehicleState deep;
	deep.T_map_body.translation().z() = 5;
	for (int i = 0; i < 40; i++) {
		const auto fix = stayed.measure(TVehicleState(), kStart + i);
		const bool under_water = i > 10 && i < 30;
		const auto o = dived.measure(under_water ? deep : TVehicleState(), kStart + i);
		EXPECT_EQ(!o, under_water) << i;
		if (!o) continue;
		EXPECT_EQ(fixIn(o), fixIn(fix)) << i;
	}
}

TEST(SimulatedPressure, OffsetStartsAndWalksAsStated)
{
	const TPressureSpec spec = wanderingPressure();
	std::vector<double> start, walked;
	for (unsigned seed = 1; seed <= kSeeds; seed++) {
		CSimulatedPressure with("PRESSURE", spec, {}, seed), without("PRESSURE", TPressureSpec(), {}, seed);
		for (int i = 0; i <= 50; i++) {
			const double t = kStart + i / spec.rate;
			const double error = pressureIn(with.measure(TVehicleState(), t)) -
								 pressureIn(without.measure(TVehicleState(), t));
			EXPECT_NEAR(error, with.offset(), 1e-9) << "seed " << seed << ", reading " << i;
			if (i == 0) start.push_back(with.offset());
		}
		walked.push_back(with.offset() - start.back());
		EXPECT_EQ(without.offset(), 0) << seed;
	}
	expectWhite(start, spec.sigma_offset, "at the start");
	expectWhite(walked, spec.offset_walk * std::sqrt(10.0), "walk in 10 s");
	expectCorrelation(start, walked, 0, "start and walk");
}

TEST(SimulatedPressure, TideIsTheSurfacesHeightSinceTheStart)
{
	TSimulatedPressureOptions options;
	options.tide_amplitude = 1.7, options.tide_period = 600;
	double phases = 0;
	for (unsigned seed = 1; seed <= 20; seed++) {
		const CTide tide(options, seed);
		EXPECT_EQ(tide.since(0), 0) << seed;
		double high = -1e9, low = 1e9;
		for (int t = 0; t < 600; t++) {
			const double h = tide.since(t);
			high = std::max(high, h), low = std::min(low, h);
			EXPECT_NEAR(tide.since(t + 600), h, 1e-9) << "period, seed " << seed;
			EXPECT_NEAR(h + tide.since(t + 300), tide.since(300), 1e-9) << "half period, seed " << seed;
		}
		EXPECT_NEAR(high - low, 2 * 1.7, 1e-3) << seed;
		phases += high > 1.7;
	}
	EXPECT_GT(phases, 2) << "some logs start below the mean";
	EXPECT_LT(phases, 18) << "and some above";
}

TEST(SimulatedPressure, HighWaterIsMorePressureOverEverySensor)
{
	TSimulatedPressureOptions options;
	options.tide_amplitude = 1.7, options.tide_period = 100;
	TPressureSpec spec;
	spec.sigma = 1e-9;
	const CTide tide(options, 6);
	CSimulatedPressure bow("BOW", spec, options, 6), stern("STERN", spec, options, 6);
	TVehicleState state;
	state.T_map_body.translation().z() = 3;
	for (int i = 0; i < 100; i++) {
		for (auto* sensor : {&bow, &stern}) {
			const double depth = spec.depth(pressureIn(sensor->measure(state, kStart + i)));
			EXPECT_NEAR(depth, 3 + tide.since(i), 1e-9) << "t = " << i;
			EXPECT_NEAR(sensor->offset(), spec.water_density * kGravity * tide.since(i), 1e-6) << "t = " << i;
		}
	}
}

TEST(SensorBank, TellsTheErrorsThatItsSensorsDrew)
{
	TSimulationOptions options;
	options.dvl.random_scale = true, options.pressure.tide_amplitude = 2, options.pressure.tide_period = 60;
	TSensorSuite suite = TSensorSuite::sparus2();
	suite.ahrs.at("AHRS").sigma_heading_bias = 0.1, suite.gps.at("GPS").sigma_bias = 1;
	CSensorBank bank(options, suite);
	CSimulatedAhrs twin("AHRS", suite.ahrs.at("AHRS"), options.ahrs, options.run.seed);
	while (bank.nextTime() < 7) {
		const double stamp = options.run.start_time + bank.nextTime();
		const auto o = bank.measure(TVehicleState());
		if (o->sensorLabel != "AHRS") continue;
		EXPECT_EQ(attitudeIn(o), attitudeIn(twin.measure(TVehicleState(), stamp)));
		EXPECT_EQ(bank.models().ahrs.at("AHRS")->error(), twin.error());
	}
	const TSensorModels& models = bank.models();
	EXPECT_NE(models.dvl.at("DVL")->scale(), 1);
	EXPECT_NE(models.pressure.at("PRESSURE")->offset(), 0);
	EXPECT_NE(models.gps.at("GPS")->bias(), Vector2d(0, 0));
	EXPECT_NE(models.imu.at("IMU")->gyroBias(), Vector3d(0, 0, 0));
	options.run.dvl = false;
	EXPECT_TRUE(CSensorBank(options, suite).models().dvl.empty()) << "switched off";
}
