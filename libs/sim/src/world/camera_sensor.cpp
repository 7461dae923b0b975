#include <posidonia/sim/camera_sensor.h>
#include <posidonia/sim/random.h>

#include <cmath>

namespace posidonia
{
namespace
{
/** x with P(normal <= x) = p, by Newton's method on erfc. */
double normalQuantile(double p)
{
	double x = 0;
	for (int i = 0; i < 60; i++) {
		const double error = 0.5 * std::erfc(-x / std::sqrt(2.0)) - p;
		const double density = std::exp(-x * x / 2) / std::sqrt(2 * M_PI);
		x -= std::clamp(error / density, -0.5, 0.5);
	}
	return x;
}
}  // namespace

CCameraSensor::CCameraSensor(const TStereoCamera& camera, const TCameraOptions& options)
	: m_width(camera.width)
{
	const double dark = options.noise > 0 ? options.noise : 1;
	const int n = 1 << kNoiseBits;
	for (int i = 0; i < n; i++)
		m_quantiles.push_back(static_cast<float>(dark * normalQuantile((i + 0.5) / n)));
	for (int i = 0; i <= 255 * static_cast<int>(kPerGrey); i++) {
		const double variance =
			options.noise * options.noise + options.photon_gain * (i / static_cast<double>(kPerGrey));
		m_growth.push_back(static_cast<float>(std::sqrt(variance) / dark));
	}
	const double corner = std::hypot(camera.width, camera.height) / 2;
	for (int v = 0; v < camera.height; v++)
		for (int u = 0; u < camera.width; u++) {
			const double off =
				std::hypot(u - (camera.width - 1) / 2.0, v - (camera.height - 1) / 2.0) / corner;
			m_vignetting.push_back(static_cast<float>(1 - options.vignetting * off * off));
		}
}

void CCameraSensor::mask(const std::vector<uint8_t>& lit)
{
	for (size_t i = 0; i < lit.size(); i++)
		m_vignetting[i] *= lit[i];
}

void CCameraSensor::develop(int v, const float* light, uint64_t row_seed, uint8_t* out) const
{
	const float* vignetting = m_vignetting.data() + static_cast<size_t>(v) * static_cast<size_t>(m_width);
	constexpr uint64_t mask = (1 << kNoiseBits) - 1;
	uint64_t bits = 0;
	for (int u = 0; u < m_width; u++) {
		bits = u % 4 == 0 ? mixed(row_seed + static_cast<uint64_t>(u)) : bits >> 16;
		const float expected = light[u] * vignetting[u];
		const float grey = expected + m_quantiles[bits & mask] * noiseGrowth(expected);
		out[u] = static_cast<uint8_t>(std::min(std::max(grey + 0.5f, 0.0f), 255.0f));
	}
}
}  // namespace posidonia
