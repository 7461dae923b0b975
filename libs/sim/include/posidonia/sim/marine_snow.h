#pragma once

#include <posidonia/base/options.h>
#include <posidonia/geometry/stereo_camera.h>

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

namespace posidonia
{
/** Section [MarineSnow]: bright flakes in the water, others in each frame, the same for both eyes. */
struct TSnowOptions
{
	double density{0}, size{0.003}, brightness{150}, reach{1.5};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("density", density, atLeast(0), "Flakes a cubic metre of water [1/m^3]; 0: none");
		v.number("size", size, above(0), "Their mean diameter [m]");
		v.number("brightness", brightness, atLeast(0), "Grey that a flake adds where it fills a pixel");
		v.number("reach", reach, above(0), "Farther from the camera there are none [m]");
	}
};

/** A flake in map. */
struct TFlake
{
	Eigen::Vector3d position;  ///< [m]
	double diameter;		   ///< [m]
};

/** Flakes in the field of view of the camera at T_map_camera, from 0.15 m on: a Poisson number of them,
 * evenly spread over the volume, diameters even in +-50 % of the mean. */
std::vector<TFlake> drawFlakes(
	const TSnowOptions& options, const TStereoCamera& camera, const Eigen::Isometry3d& T_map_camera,
	uint64_t seed);
inline constexpr double kNearestFlake = 0.15;  ///< Along the axis [m]
}  // namespace posidonia
