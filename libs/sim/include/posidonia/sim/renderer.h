#pragma once

#include <posidonia/obs/observations.h>
#include <posidonia/sim/camera_sensor.h>
#include <posidonia/sim/floor.h>
#include <posidonia/sim/marine_snow.h>
#include <posidonia/sim/sea_floor.h>
#include <posidonia/sim/water.h>

#include <memory>

namespace posidonia
{
class CFloorView;
struct TLevelView;
struct TMipLevels;
struct TPixelRow;

/** What lies between the floor and the pixels. */
struct TOptics
{
	TWaterOptions water;
	TCameraOptions camera;
	TLampOptions lamp;
	TPortOptions port;
};

/** Renders the floor as the true cameras see it: pixel centres at whole numbers, the floor's texture seen
 * from above. Const and thread-safe; a picture depends on its arguments only. */
class CFloorRenderer
{
   public:
	/** `texture` must outlive the renderer; `camera`: true intrinsics. */
	CFloorRenderer(
		const CFloorTexture& texture, std::shared_ptr<const CSeaFloor> floor, const TStereoCamera& camera,
		const TOptics& optics, double lamp_distance = 0);
	/** A flat floor at `depth` [m] in even light. */
	CFloorRenderer(
		const CFloorTexture& texture, double depth, const TStereoCamera& camera, const TWaterOptions& water,
		const TCameraOptions& sensor);
	~CFloorRenderer();

	/** Where camera and lamp are at an instant. */
	struct TMoment
	{
		Eigen::Isometry3d T_map_camera;
		Eigen::Vector3d lamp{0, 0, 0};	///< [m, map]
	};
	/** What a picture shows beside the floor. */
	struct TConditions
	{
		std::vector<TFlake> flakes;
		double flake_brightness{0};
		double water_factor{1};	 ///< On both coefficients of the water
	};
	/** The mean of the moments of an exposure; `noise_seed` fixes the sensor's noise. CV_8UC1. */
	cv::Mat render(
		const std::vector<TMoment>& exposure, const TConditions& conditions, uint64_t noise_seed) const;
	/** One moment in the water as it is. */
	cv::Mat render(const Eigen::Isometry3d& T_map_camera, uint64_t noise_seed) const
	{
		return render({{T_map_camera}}, {}, noise_seed);
	}
	/** Depth along the optical axis of what each pixel shows [m]; infinite where there is no floor. */
	cv::Mat1f depths(const Eigen::Isometry3d& T_map_camera) const;

   private:
	std::unique_ptr<const CFloorView> viewFrom(const TMoment& moment) const;
	TMipLevels levelsAt(double depth) const;
	void addLight(const CFloorView& view, const CWaterTables& water, int v, TPixelRow& row) const;
	cv::Mat1f snowLight(
		const std::vector<TMoment>& exposure, const TConditions& conditions, const CWaterTables& water) const;
	void addFlake(
		const TFlake& flake, const TMoment& moment, double brightness, const CWaterTables& water,
		cv::Mat1f& light) const;

	const CFloorTexture& m_texture;
	std::shared_ptr<const CSeaFloor> m_floor;
	TStereoCamera m_camera;
	TOptics m_optics;
	double m_lamp_distance;
	TViewRays m_rays;
	CWaterTables m_water;
	CCameraSensor m_sensor;
	std::vector<TLevelView> m_level_views;
	std::vector<TMipLevels> m_levels;  ///< By depth along the axis, TMipLevels::kStep apart
	std::vector<float> m_ray_length;   ///< By pixel: of the pin-hole's ray with unit depth
};

/** Both pictures of the rig with the LEFT camera at T_map_camera; frame numbers give independent noise. */
TGreyPair renderPair(
	const CFloorRenderer& renderer, const Eigen::Isometry3d& T_map_camera, double baseline, uint64_t seed,
	uint64_t frame);
}  // namespace posidonia
