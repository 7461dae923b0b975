#include <posidonia/sim/water.h>

#include <array>
#include <cmath>
#include <map>

namespace posidonia
{
namespace
{
/** Diffuse attenuation of daylight K_d [1/m], mean of 525 and 550 nm (Jerlov 1976, Table XXVII): green, where
 * a grey camera under water gets most of its light. */
const std::map<std::string, double> kDiffuseAttenuation{
	{"I", 0.053},  {"IA", 0.058}, {"IB", 0.063}, {"II", 0.082}, {"III", 0.118},
	{"1C", 0.125}, {"3C", 0.195}, {"5C", 0.305}, {"7C", 0.475}, {"9C", 0.705}};

/** Kirk (1984): K_d^2 = a^2 + 0.256 a b for light from above, so that K_d follows from absorption a and
 * scattering b. */
constexpr double kKirk = 0.256;

/** Share of the scattered light that stays in the picture: the forward peak, within a pixel's width. */
constexpr double kForwardLost = 0.2;

/** A lamp in the lens would light the water at the lens without bound [m]. */
constexpr double kNearestLamp = 0.05;

/** b / a by K_d, between the three waters that Petzold measured at 514 nm (1972; Mobley 1994, table 3.10):
 * clear ocean a = 0.114, b = 0.037; coast 0.179, 0.219; harbour 0.366, 1.824 [1/m]. */
double scatteringRatio(double K_d)
{
	constexpr std::array<std::array<double, 2>, 3> stations{{{0.114, 0.037}, {0.179, 0.219}, {0.366, 1.824}}};
	std::array<double, 3> log_K, log_ratio;
	for (size_t i = 0; i < 3; i++) {
		const auto [a, b] = stations[i];
		log_K[i] = std::log(std::sqrt(a * a + kKirk * a * b));
		log_ratio[i] = std::log(b / a);
	}
	const double x = std::clamp(std::log(K_d), log_K[0], log_K[2]);
	const size_t i = x < log_K[1] ? 0 : 1;
	const double share = (x - log_K[i]) / (log_K[i + 1] - log_K[i]);
	return std::exp(log_ratio[i] + share * (log_ratio[i + 1] - log_ratio[i]));
}

/** Share of the veil by range, in steps of `step` [m], in even light: 1 - exp(-b r). */
std::vector<double> evenVeil(double backscatter, double step, int steps)
{
	std::vector<double> share;
	for (int i = 0; i < steps; i++)
		share.push_back(1 - std::exp(-backscatter * (i * step)));
	return share;
}

/** The same beside a lamp, `offset` [m] from the camera, that lights the water by 1 / distance^2, there and
 * back: single scattering along the ray (Jaffe 1990). */
std::vector<double> lampVeil(double backscatter, double offset, double step, int steps)
{
	std::vector<double> share{0};
	for (int i = 1; i < steps; i++) {
		const double s = (i - 0.5) * step;
		share.push_back(share.back() + std::exp(-2 * backscatter * s) / (s * s + offset * offset));
	}
	for (double& x : share)
		x = backscatter > 0 ? x / share.back() : 0;	 // (the last one last: it is divided by itself)
	return share;
}
}  // namespace

TWaterCoefficients coefficientsOf(const TWaterOptions& options)
{
	if (options.jerlov == "none") return {options.attenuation, options.backscatter};
	const double K_d = kDiffuseAttenuation.at(options.jerlov), ratio = scatteringRatio(K_d);
	const double a = K_d / std::sqrt(1 + kKirk * ratio), b = ratio * a;
	return {a + kForwardLost * b, a + b};
}

CWaterTables::CWaterTables(
	const TWaterOptions& water, const TLampOptions& lamp, double lamp_distance, double factor)
{
	TWaterCoefficients c = coefficientsOf(water);
	c = {factor * c.attenuation, factor * c.backscatter};
	const double step = static_cast<double>(kStep);
	const auto share = lamp.on()
						   ? lampVeil(c.backscatter, std::max(lamp_distance, kNearestLamp), step, kSteps)
						   : evenVeil(c.backscatter, step, kSteps);
	for (int i = 0; i < kSteps; i++) {
		m_direct.push_back(static_cast<float>(std::exp(-c.attenuation * (i * step))));
		m_veil.push_back(static_cast<float>(water.veiling_light * share[static_cast<size_t>(i)]));
	}
}
}  // namespace posidonia
