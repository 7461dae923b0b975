#pragma once

#include <posidonia/sim/renderer.h>

namespace posidonia
{
/** Two neighbouring mip levels and the share of the coarser one. */
struct TMipLevels
{
	static constexpr float kStep = 0.01f;  ///< Of tables by depth [m]
	uint8_t fine;
	float share;
};

/** What is known of one row of the picture, by column. */
struct TPixelRow
{
	explicit TPixelRow(size_t width)
		: col(width),
		  row(width),
		  level(width),
		  share(width),
		  range(width),
		  way(width),
		  irradiance(width),
		  radiance(width),
		  coarse(width),
		  light(width),
		  work_at(width),
		  work_x(width),
		  work_y(width)
	{
	}
	std::vector<double> col, row;		  ///< On level 0 of the texture, + 0.5 (areas, not centres)
	std::vector<uint8_t> level;			  ///< Finer of the two levels of the texture
	std::vector<float> share;			  ///< Of the coarser
	std::vector<float> range, way;		  ///< In the water: floor to camera; lamp to floor to camera [m]
	std::vector<float> irradiance;		  ///< Light on the floor; 1: as on level floor by day
	std::vector<float> radiance, coarse;  ///< Of the texture; of its coarser level [grey levels]
	std::vector<float> light;			  ///< Sum over the moments of the exposure [grey levels]
	std::vector<int> work_at;
	std::vector<float> work_x, work_y;
};

/** The floor from one place. */
class CFloorView
{
   public:
	virtual ~CFloorView() = default;
	/** Where the rays of row `v` of the picture meet the floor: fills col to irradiance. */
	virtual void intersectRow(int v, TPixelRow& row) const = 0;
};

/** Level floor, pin-hole and even light: in closed form. */
class CPlaneView : public CFloorView
{
   public:
	/** `ray_length`: by pixel, of the ray with unit depth; `resolution` [m/px], `foot`: texture pixel
	 * straight below the camera; `height` [m] over the floor. */
	CPlaneView(
		const TStereoCamera& camera, const std::vector<float>& ray_length,
		const Eigen::Matrix3d& R_map_camera, double height, const Eigen::Vector2d& foot, double resolution,
		const TMipLevels& levels)
		: m_camera(camera),
		  m_ray_length(ray_length),
		  m_R(R_map_camera),
		  m_height(height),
		  m_foot(foot),
		  m_resolution(resolution),
		  m_levels(levels)
	{
	}
	void intersectRow(int v, TPixelRow& row) const override;

   private:
	const TStereoCamera& m_camera;
	const std::vector<float>& m_ray_length;
	Eigen::Matrix3d m_R;
	double m_height;
	Eigen::Vector2d m_foot;
	double m_resolution;
	TMipLevels m_levels;
};

/** Any floor, any rays, any light: from the ranges of all pixels. */
class CTracedView : public CFloorView
{
   public:
	struct TWorld
	{
		const CSeaFloor& floor;
		const CFloorTexture& texture;
		const TViewRays& rays;
		const TLampOptions& lamp;
		const std::vector<TMipLevels>& levels;	///< By depth
	};
	CTracedView(const TWorld& world, const CFloorRenderer::TMoment& moment);
	void intersectRow(int v, TPixelRow& row) const override;

   private:
	/** A row of points of the floor. */
	struct TPoints
	{
		explicit TPoints(size_t n) : camera(n), map(n), north(n), east(n), slope(n) {}
		TPixelVectors camera, map;		 ///< From the camera, in its axes and in those of map [m]
		std::vector<float> north, east;	 ///< In map [m]
		CSeaFloor::TGradients slope;
	};
	void locate(int v, TPixelRow& row, TPoints& points) const;
	void lightByDay(const TPoints& points, TPixelRow& row) const;
	void lightByLamp(const TPoints& points, TPixelRow& row) const;

	TWorld m_world;
	Eigen::Matrix3f m_R;
	Eigen::Vector3d m_centre;
	Eigen::Vector3f m_lamp;	 ///< From the camera, in map axes [m]
	cv::Mat1f m_ranges;
	mutable TPoints m_points;  ///< Of the row in work: a view serves one thread
};
}  // namespace posidonia
