#include <gtest/gtest.h>
#include <posidonia/obs/frames.h>

#include "sensor_test_tools.h"

/** A Kalman filter that models exactly what sensors.ini states must find the simulated readings consistent:
 * its innovations (NIS) and its errors against the truth that the models tell (NEES) have the size that it
 * claims. */
using namespace posidonia;
using namespace posidonia::testing;

namespace
{
constexpr double kStart = 1420070400;
constexpr int kSeeds = 300, kReadings = 120;

/** One error b' = phi b + N(0, q), seen through white noise of variance r. */
struct TErrorModel
{
	double prior, phi, q, r;  ///< Variances but phi
};
TErrorModel gaussMarkov(double sigma, double time, double rate, double white)
{
	const double phi = std::exp(-1 / (rate * time));
	return {sigma * sigma, phi, sigma * sigma * (1 - phi * phi), white * white};
}
TErrorModel walk(double start, double density, double rate, double white)
{
	return {start * start, 1, density * density / rate, white * white};
}

/** One reading's error and, of that, the part that is not white. */
struct TReading
{
	double error, truth;
};

/** Sums over readings and seeds. */
struct TConsistency
{
	double nis{0}, nees{0};
};
/** `next()` gives one reading after the other. */
template <class NEXT>
void filter(const TErrorModel& model, TConsistency& sums, NEXT&& next)
{
	double b = 0, P = model.prior;
	for (int i = 0; i < kReadings; i++) {
		if (i > 0) b *= model.phi, P = model.phi * P * model.phi + model.q;
		const TReading reading = next(i);
		const double innovation = reading.error - b, S = P + model.r;
		sums.nis += innovation * innovation / S / (kSeeds * kReadings);
		b += P / S * innovation;
		P *= model.r / S;
		if (i == kReadings - 1) sums.nees += (b - reading.truth) * (b - reading.truth) / P / kSeeds;
	}
}
void expectConsistent(const TConsistency& sums)
{
	EXPECT_NEAR(sums.nis, 1, 4.5 * std::sqrt(2.0 / (kSeeds * kReadings))) << "NIS";
	EXPECT_NEAR(sums.nees, 1, 4.5 * std::sqrt(2.0 / kSeeds)) << "NEES";
}
}  // namespace

TEST(FilterConsistency, HeadingOfTheAhrs)
{
	TAhrsSpec spec;
	spec.sigma_heading_bias = 0.03, spec.bias_time = 10;
	const auto model = gaussMarkov(spec.sigma_heading_bias, spec.bias_time, spec.rate, spec.sigma_heading);
	TConsistency sums;
	for (int seed = 1; seed <= kSeeds; seed++) {
		CSimulatedAhrs ahrs("AHRS", spec, {}, seed);
		filter(model, sums, [&](int i) -> TReading {
			const auto o = ahrs.measure(TVehicleState(), kStart + i / spec.rate);
			const auto R = attitudeOf(dynamic_cast<mrpt::obs::CObservationIMU&>(*o)).value();
			return {yawPitchRoll(R)[0], ahrs.error().z()};
		});
	}
	expectConsistent(sums);
}

TEST(FilterConsistency, NorthOfTheGps)
{
	TGpsSpec spec;
	spec.sigma_bias = 1.5, spec.bias_time = 60;
	const auto model = gaussMarkov(spec.sigma_bias, spec.bias_time, spec.rate, spec.sigma_horizontal);
	TConsistency sums;
	for (int seed = 1; seed <= kSeeds; seed++) {
		CSimulatedGps gps("GPS", spec, {}, {}, seed);
		filter(model, sums, [&](int i) -> TReading {
			const auto o = gps.measure(TVehicleState(), kStart + i);
			const auto& fix = dynamic_cast<mrpt::obs::CObservationGPS&>(*o)
								  .getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>()
								  .fields;
			const TGeodetic place{fix.latitude_degrees, fix.longitude_degrees, fix.altitude_meters};
			return {nedFromGeodetic(place, {}).x(), gps.bias().x()};
		});
	}
	expectConsistent(sums);
}

TEST(FilterConsistency, OffsetOfThePressure)
{
	TPressureSpec spec;
	spec.sigma_offset = 300, spec.offset_walk = 20;
	const auto model = walk(spec.sigma_offset, spec.offset_walk, spec.rate, spec.sigma);
	TConsistency sums;
	for (int seed = 1; seed <= kSeeds; seed++) {
		CSimulatedPressure pressure("PRESSURE", spec, {}, seed);
		filter(model, sums, [&](int i) -> TReading {
			const auto o = pressure.measure(TVehicleState(), kStart + i / spec.rate);
			const double p = dynamic_cast<CObservationPressure&>(*o).pressure;
			return {p - spec.surface_pressure, pressure.offset()};
		});
	}
	expectConsistent(sums);
}

TEST(FilterConsistency, BiasesOfTheImu)
{
	TImuSpec spec;
	spec.gyro_random_walk = 3e-3;  // strong enough to show in 120 readings; the accelerometer's is as shipped
	const TSimulatedImuOptions options;
	const double white = std::sqrt(spec.rate);
	const auto gyro =
		walk(options.gyro_bias, spec.gyro_random_walk, spec.rate, spec.gyro_noise_density * white);
	const auto accel =
		walk(options.accel_bias, spec.accel_random_walk, spec.rate, spec.accel_noise_density * white);
	TConsistency of_gyro, of_accel;
	for (int seed = 1; seed <= kSeeds; seed++) {
		CSimulatedImu a("IMU", spec, options, seed), b("IMU", spec, options, seed);
		filter(gyro, of_gyro, [&](int i) -> TReading {
			return {readingOf(a.measure(TVehicleState(), kStart + i / spec.rate)).rate.y(), a.gyroBias().y()};
		});
		filter(accel, of_accel, [&](int i) -> TReading {
			const auto r = readingOf(b.measure(TVehicleState(), kStart + i / spec.rate));
			return {r.force.z() + kGravity, b.accelBias().z()};
		});
	}
	expectConsistent(of_gyro);
	expectConsistent(of_accel);
}

/** The scale, drawn once, seen by each beam through its own white noise: 4 beams a ping. */
TEST(FilterConsistency, ScaleAndBeamsOfTheDvl)
{
	const TDvlSpec spec = TSensorSuite::sparus2().dvl.at("DVL");
	TSimulatedDvlOptions options;
	options.random_scale = true, options.beam_loss = 0.1;
	TVehicleState state;
	state.v_body = {0.5, 0.2, 0.1};
	const Eigen::Vector4d truth =
		spec.beams().transpose() * spec.T_body_sensor().linear().transpose() * state.v_body;
	const double r = spec.sigmaBeam() * spec.sigmaBeam();
	double nis = 0, nees = 0, n = 0;
	for (int seed = 1; seed <= kSeeds; seed++) {
		CSimulatedDvl dvl("DVL", spec, options, {}, flatFloor(), seed);
		double b = 0, P = spec.sigma_scale * spec.sigma_scale;
		for (int i = 0; i < kReadings; i++) {
			const auto o = dvl.measure(state, kStart + i / spec.rate);
			for (int k = 0; k < 4; k++) {
				const double y = asDvl(o).beam_velocities[k];
				if (std::isnan(y)) continue;
				const double innovation = y - (1 + b) * truth[k], S = truth[k] * P * truth[k] + r;
				nis += innovation * innovation / S, n++;
				b += P * truth[k] / S * innovation;
				P *= r / S;
			}
		}
		nees += (1 + b - dvl.scale()) * (1 + b - dvl.scale()) / P / kSeeds;
	}
	EXPECT_NEAR(nis / n, 1, 4.5 * std::sqrt(2 / n)) << "NIS";
	EXPECT_NEAR(nees, 1, 4.5 * std::sqrt(2.0 / kSeeds)) << "NEES";
}
