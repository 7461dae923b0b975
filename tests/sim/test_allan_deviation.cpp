#include <gtest/gtest.h>

#include <array>

#include "sensor_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** Overlapping Allan variance of samples dt apart at tau = m dt (IEEE 952-1997, annex C): half the mean
 * square of the difference of two adjacent means over m samples. */
double allanVariance(const std::vector<double>& samples, size_t m)
{
	std::vector<double> sum(1, 0);
	for (double x : samples)
		sum.push_back(sum.back() + x);
	double squares = 0;
	const size_t n = samples.size() + 1 - 2 * m;
	for (size_t i = 0; i < n; i++) {
		const double difference = (sum[i + 2 * m] - 2 * sum[i + m] + sum[i]) / static_cast<double>(m);
		squares += difference * difference;
	}
	return squares / 2 / static_cast<double>(n);
}

constexpr double kRate = 20;
constexpr size_t kSamples = 600000;	 // 30 000 s

/** Six channels at rest: gyros, then accelerometers. */
using static_log_t = std::array<std::vector<double>, 6>;
static_log_t staticLog(const TImuSpec& spec)
{
	CSimulatedImu imu("IMU", spec, TSimulatedImuOptions(), 4);
	static_log_t log;
	for (size_t i = 0; i < kSamples; i++) {
		const TImuReading r = readingOf(imu.measure(TVehicleState(), static_cast<double>(i) / kRate));
		for (size_t k = 0; k < 3; k++)
			log[k].push_back(r.rate[k]), log[3 + k].push_back(r.force[k]);
	}
	return log;
}
/** Root mean Allan variance of three channels from `first` on. */
double allanDeviation(const static_log_t& log, size_t first, double tau)
{
	const auto m = static_cast<size_t>(std::lround(tau * kRate));
	double variance = 0;
	for (size_t k = first; k < first + 3; k++)
		variance += allanVariance(log[k], m) / 3;
	return std::sqrt(variance);
}
/** Relative tolerance at tau: 4.5 standard errors of a deviation from three times duration / tau clusters. */
double tolerance(double tau)
{
	return 4.5 / std::sqrt(2 * 3 * kSamples / kRate / tau);
}
void expectDeviation(
	const static_log_t& log, size_t first, double tau, double expected, const std::string& what)
{
	EXPECT_NEAR(allanDeviation(log, first, tau) / expected, 1, tolerance(tau)) << what << ", tau = " << tau;
}
TImuSpec specWith(double gyro_n, double gyro_k, double accel_n, double accel_k)
{
	TImuSpec spec;
	spec.rate = kRate;
	spec.gyro_noise_density = gyro_n, spec.gyro_random_walk = gyro_k;
	spec.accel_noise_density = accel_n, spec.accel_random_walk = accel_k;
	return spec;
}
}  // namespace

/** sigma(tau)^2 = N^2 / tau + K^2 tau / 3: the spec's densities are the Allan parameters N and K, and neither
 * the turn-on bias nor gravity shows. */
TEST(AllanDeviation, OfAnImuAtRestIsThatOfItsSpec)
{
	const TImuSpec spec = specWith(3.394e-4, 3.879e-5, 4e-3, 6e-4);
	const static_log_t log = staticLog(spec);
	const auto law = [](double n, double k, double tau) { return std::sqrt(n * n / tau + k * k * tau / 3); };
	for (const double tau : {0.25, 1.0, 5.0, 25.0, 100.0, 300.0}) {
		const double gyro = law(spec.gyro_noise_density, spec.gyro_random_walk, tau);
		const double accel = law(spec.accel_noise_density, spec.accel_random_walk, tau);
		expectDeviation(log, 0, tau, gyro, "gyro");
		expectDeviation(log, 3, tau, accel, "accelerometer");
	}
	EXPECT_NEAR(allanDeviation(log, 0, 1) / spec.gyro_noise_density, 1, 0.03) << "N at 1 s";
	EXPECT_NEAR(allanDeviation(log, 3, 1) / spec.accel_noise_density, 1, 0.03) << "N at 1 s";
	const double tau = 300;
	EXPECT_NEAR(
		allanDeviation(log, 0, tau) / (spec.gyro_random_walk * std::sqrt(tau / 3)), 1, tolerance(tau));
	EXPECT_NEAR(
		allanDeviation(log, 3, tau) / (spec.accel_random_walk * std::sqrt(tau / 3)), 1, tolerance(tau));
}
