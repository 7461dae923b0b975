#pragma once

#include <posidonia/obs/observations.h>
#include <posidonia/sim/floor.h>

namespace posidonia
{
/** Section [Water]: first-order image formation, grey: I = J exp(-attenuation r) + B (1 - exp(-backscatter
 * r)) over the range r of each pixel (uniform limit of Jaffe-McGlamery; two coefficients as in Akkaynak and
 * Treibitz 2018). */
struct TWaterOptions
{
	double attenuation{0.15}, backscatter{0.15}, veiling_light{75};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("attenuation", attenuation, atLeast(0), "Attenuation of the direct light [1/m]; 0: clear");
		v.number("backscatter", backscatter, atLeast(0), "Growth of the veil [1/m]; 0: none");
		v.number("veiling_light", veiling_light, between(0, 255), "Grey of endless water");
	}
};

/** Section [Camera]: the sensor's own imperfections. */
struct TCameraOptions
{
	double noise{3}, vignetting{0.25};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("noise", noise, atLeast(0), "White noise of a pixel, sigma [grey levels]");
		v.number("vignetting", vignetting, between(0, 1), "Loss of light in the corners, 0 to 1");
	}
};

/** Renders the flat floor as the true cameras see it: exact pin-hole, pixel centres at whole numbers. Const
 * and thread-safe; a picture depends on its arguments only. */
class CFloorRenderer
{
   public:
	/** `floor` must outlive the renderer. `depth`: of the floor [m]; `camera`: true intrinsics. */
	CFloorRenderer(
		const CFloorTexture& floor, double depth, const TStereoCamera& camera, const TWaterOptions& water,
		const TCameraOptions& sensor);

	/** What one camera at T_map_camera sees; `noise_seed` fixes the sensor's noise, `water_factor` multiplies
	 * both coefficients of the water. CV_8UC1. */
	cv::Mat render(const Eigen::Isometry3d& T_map_camera, uint64_t noise_seed, double water_factor = 1) const;

   private:
	struct TRays;
	struct TRow;
	struct TLevels;
	TLevels chooseLevels(double height) const;
	void intersectRow(const TRays& rays, TRow& row) const;
	void sampleRow(const TLevels& levels, TRow& row) const;
	void develop(int v, const TRow& row, float water_factor, uint64_t noise_seed, uint8_t* out) const;
	void buildTables(const TWaterOptions& water, const TCameraOptions& sensor);

	const CFloorTexture& m_floor;
	double m_depth;
	TStereoCamera m_camera;
	std::vector<float> m_direct, m_veil;			///< By range, kRangeStep apart
	std::vector<float> m_noise;						///< Quantiles of the pixel noise
	std::vector<float> m_vignetting, m_ray_length;	///< By pixel
};

/** Both pictures of the rig with the LEFT camera at T_map_camera; frame numbers give independent noise. */
TGreyPair renderPair(
	const CFloorRenderer& renderer, const Eigen::Isometry3d& T_map_camera, double baseline, uint64_t seed,
	uint64_t frame, double water_factor = 1);
}  // namespace posidonia
