#pragma once

#include <posidonia/base/options.h>
#include <posidonia/sim/lamp.h>

#include <algorithm>
#include <vector>

namespace posidonia
{
/** Section [Water]: first-order image formation, grey: I = J exp(-attenuation r) + B (1 - exp(-backscatter
 * r)) over the range r of each pixel (uniform limit of Jaffe-McGlamery; two coefficients as in Akkaynak and
 * Treibitz 2018). */
struct TWaterOptions
{
	double attenuation{0.15}, backscatter{0.15}, veiling_light{75};
	std::string jerlov{"none"};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice(
			"jerlov", jerlov, {"none", "I", "IA", "IB", "II", "III", "1C", "3C", "5C", "7C", "9C"},
			"Jerlov's water type (1976), instead of the two coefficients; none: as they say");
		v.number("attenuation", attenuation, atLeast(0), "Attenuation of the direct light [1/m]; 0: clear");
		v.number("backscatter", backscatter, atLeast(0), "Growth of the veil [1/m]; 0: none");
		v.number("veiling_light", veiling_light, between(0, 255), "Grey of endless water");
	}
};

/** Both coefficients [1/m] of a grey camera. */
struct TWaterCoefficients
{
	double attenuation, backscatter;
};
/** Those of the options: the explicit ones, or of the Jerlov type. */
TWaterCoefficients coefficientsOf(const TWaterOptions& options);

/** Tables by length of the way: entries `step` [m] apart, `last` the last index. */
struct TWaterView
{
	const float *direct, *veil;
	float step, last;
};

/** What is left of the floor's light and what the water adds, by length of the way, in steps of 5 mm. */
class CWaterTables
{
   public:
	/** `factor` multiplies both coefficients; `lamp_distance` [m]: of the lamp from the camera. */
	CWaterTables(const TWaterOptions& water, const TLampOptions& lamp, double lamp_distance, double factor);

	/** Share of the light left after `way` [m]. */
	float direct(float way) const { return m_direct[index(way)]; }
	/** Grey that the water adds before a point `range` [m] away. */
	float veil(float range) const { return m_veil[index(range)]; }

	TWaterView view() const { return {m_direct.data(), m_veil.data(), kStep, kSteps - 1.0f}; }

   private:
	static constexpr float kStep = 0.005f;	///< [m]
	static constexpr int kSteps = 8192;		///< Up to 41 m
	static size_t index(float way)
	{
		return static_cast<size_t>(static_cast<int>(std::min(way / kStep + 0.5f, kSteps - 1.0f)));
	}
	std::vector<float> m_direct, m_veil;
};
}  // namespace posidonia
