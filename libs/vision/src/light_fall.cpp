#include <posidonia/vision/light_fall.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
namespace
{
/** What is known of a slope without a measurement: sigma. */
constexpr double PRIOR_SIGMA = 0.5;
/** A log-ratio of contrasts is at least so uncertain. */
constexpr double LEAST_NOISE = 0.005;
/** Pull over size^2 times relative slope. A Gaussian blob has 1/4; matched key points over known floors, 0.4
 * to 0.5 (README). */
constexpr double PULL = 0.45;
/** SIFT's smallest key point [px]. */
constexpr double SMALLEST = 2;

double median(std::vector<double> v)
{
	std::nth_element(v.begin(), v.begin() + static_cast<long>(v.size() / 2), v.end());
	return v[v.size() / 2];
}
}  // namespace

CLightFall::CLightFall(int width, int height)
	: m_middle(0.5 * (width - 1), 0.5 * (height - 1)),
	  m_radius2(0.25 * (double(width) * width + double(height) * height))
{
}

double CLightFall::rho2(double u, double v) const
{
	return (Eigen::Vector2d(u, v) - m_middle).squaredNorm() / m_radius2;
}

double CLightFall::slopeOf(const std::vector<TSample>& samples) const
{
	// log contrast = slope x + offset (the cameras' own), x = rho_left^2 - rho_right^2; twice, the second
	// time without what lies beyond three robust standard deviations.
	double slope = 0, offset = 0, noise = 1e9;
	for (int round = 0; round < 3; round++) {
		double n = 0, x1 = 0, y1 = 0, xx = 0, xy = 0;
		std::vector<double> residuals;
		for (const TSample& s : samples) {
			const double x = rho2(s.uvr.x(), s.uvr.y()) - rho2(s.uvr.z(), s.uvr.y()),
						 y = std::log(s.contrast);
			residuals.push_back(std::abs(y - slope * x - offset));
			if (residuals.back() > 3 * noise) continue;
			n++, x1 += x, y1 += y, xx += x * x, xy += x * y;
		}
		if (n < 10) return 0;
		if (round > 0) noise = std::max(LEAST_NOISE, 1.4826 * median(residuals));
		const double spread = xx - x1 * x1 / n, prior = std::min(noise, 1.0) / PRIOR_SIGMA;
		slope = (xy - x1 * y1 / n) / (spread + prior * prior);
		offset = (y1 - slope * x1) / n;
	}
	return slope;
}

Eigen::Vector2d CLightFall::pull(const Eigen::Vector2d& uv, double octave, double slope) const
{
	const double size = SMALLEST * std::exp2(octave);
	return PULL * size * size * slope * 2 / m_radius2 * (uv - m_middle);  // size^2 times the gradient
}
}  // namespace posidonia
