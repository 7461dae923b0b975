#pragma once

#include <posidonia/base/options.h>
#include <posidonia/geometry/stereo_camera.h>

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

namespace posidonia
{
/** Section [Port]: a flat window, parallel to the picture, between the camera and the water. */
struct TPortOptions
{
	std::string kind{"none"};
	double distance{0.02}, glass{0.01}, n_glass{1.49}, n_water{1.34};
	double rectified_at{2.5};

	bool flat() const { return kind == "flat"; }

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice("kind", kind, {"none", "flat"}, "none: rays run straight, the camera is as calibrated");
		v.number("distance", distance, atLeast(0), "From the camera's centre to the glass [m]");
		v.number("glass", glass, atLeast(0), "Thickness of the glass [m]");
		v.number("n_glass", n_glass, between(1, 3), "Refractive index of the glass (acrylic: 1.49)");
		v.number("n_water", n_water, between(1, 3), "Refractive index of the water (sea water: 1.34)");
		v.number(
			"rectified_at", rectified_at, atLeast(0),
			"Pictures are rectified so that the log's pin-hole is exact at this distance along the axis [m]; "
			"0: raw pictures of a camera that was calibrated in air");
	}
};

/** Three numbers a pixel, row by row. */
struct TPixelVectors
{
	std::vector<float> x, y, z;
	explicit TPixelVectors(size_t n = 0) : x(n), y(n), z(n) {}
	void push_back(double x_i, double y_i, double z_i)
	{
		x.push_back(static_cast<float>(x_i));
		y.push_back(static_cast<float>(y_i));
		z.push_back(static_cast<float>(z_i));
	}
	Eigen::Vector3f operator[](size_t i) const { return {x[i], y[i], z[i]}; }
};

/** The rays of a picture's pixels in the camera's axes. */
struct TViewRays
{
	int width{0}, height{0};
	double focal{0};		   ///< Pixels of picture a radian near the axis, in the water [px]
	TPixelVectors origin;	   ///< Where they begin in the water [m]
	TPixelVectors direction;   ///< Unit vectors
	std::vector<uint8_t> lit;  ///< 0: no ray of the water can reach this pixel

	size_t size() const { return lit.size(); }
};

/** Those of the ideal pin-hole, or behind the port. Throws CError when rectified_at lies within the port. */
TViewRays viewRays(const TStereoCamera& camera, const TPortOptions& port);

/** A ray behind the port in the plane through the optical axis: begins at (radius, distance + glass). */
struct TPortRay
{
	double radius;		  ///< From the axis [m]
	double sine, cosine;  ///< Of the angle to the axis, in the water
};
/** The ray that leaves the camera at sin(angle in air) = `sine_air` < 1; Snell's law at both faces. */
TPortRay throughPort(const TPortOptions& port, double sine_air);
}  // namespace posidonia
