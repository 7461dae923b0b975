#pragma once

#include <posidonia/base/options.h>
#include <posidonia/geometry/stereo_camera.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace posidonia
{
/** Section [Camera]: the sensor's own imperfections. */
struct TCameraOptions
{
	double noise{3}, vignetting{0.25};
	double photon_gain{0}, exposure{0};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("noise", noise, atLeast(0), "White noise of a pixel, sigma [grey levels]");
		v.number(
			"photon_gain", photon_gain, atLeast(0),
			"Grey levels a photo-electron: the variance grows by this times the grey; 0: noise alone");
		v.number("vignetting", vignetting, between(0, 1), "Loss of light in the corners, 0 to 1");
		v.number(
			"exposure", exposure, between(0, 1), "Time that a picture is the mean of [s]; 0: no motion blur");
	}
};

/** Turns light into grey levels: vignetting, noise of the amplifier and of the photons (Foi et al. 2008: the
 * Poisson law as a Gaussian whose variance is noise^2 + photon_gain * grey), rounding. */
class CCameraSensor
{
   public:
	CCameraSensor(const TStereoCamera& camera, const TCameraOptions& options);

	/** No light reaches these pixels (row by row; 1: light does). */
	void mask(const std::vector<uint8_t>& lit);
	/** Row `v` of a picture from its light [grey levels]; the noise depends on the seed and the column. */
	void develop(int v, const float* light, uint64_t row_seed, uint8_t* out) const;

   private:
	static constexpr int kNoiseBits = 12;
	static constexpr float kPerGrey = 8;  ///< Steps of m_growth in a grey level
	float noiseGrowth(float light) const
	{
		return m_growth[static_cast<size_t>(std::min(std::max(light, 0.0f), 255.0f) * kPerGrey)];
	}

	int m_width;
	std::vector<float> m_quantiles;	  ///< Of the noise in the dark
	std::vector<float> m_growth;	  ///< Sigma by light / that of m_quantiles
	std::vector<float> m_vignetting;  ///< By pixel
};
}  // namespace posidonia
