#pragma once

#include <posidonia/base/options.h>
#include <posidonia/sim/floor.h>

#include <opencv2/core.hpp>

namespace posidonia
{
/** Section [Relief]: the shape of the floor, about [Floor] depth and over the extent of its texture. */
struct TReliefOptions
{
	std::string kind{"flat"};
	double height{0.3}, resolution{0.04};
	double hill_size{6}, slope{0}, slope_direction{0};
	double ripple_height{0.03}, ripple_length{0.6}, ripple_direction{30 * M_PI / 180};
	double boulder_density{0.1}, boulder_size{0.5};
	std::string image{"textures/noaa_reef.jpg"};
	double image_width{30};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice("kind", kind, {"flat", "procedural", "image"}, "Shape of the floor");
		v.number(
			"height", height, atLeast(0), "The whole relief lies within +- this about [Floor] depth [m]");
		v.number("resolution", resolution, between(0.005, 1), "Width of a cell of the height field [m]");
		v.number(
			"hill_size", hill_size, above(0),
			"Width of the largest hills [m]; they fill what is left of height");
		v.number("slope", slope, anyNumber(), "Rise of the whole floor [m/m]");
		v.degrees("slope_direction", slope_direction, anyNumber(), "Heading in which the floor rises [deg]");
		v.number("ripple_height", ripple_height, atLeast(0), "Sand ripples, trough to crest [m]");
		v.number("ripple_length", ripple_length, above(0), "... crest to crest [m]");
		v.degrees("ripple_direction", ripple_direction, anyNumber(), "... heading across the crests [deg]");
		v.number("boulder_density", boulder_density, atLeast(0), "Boulders a square metre [1/m^2]");
		v.number("boulder_size", boulder_size, above(0), "Their mean width [m]; 0.35 of it high");
		v.text("image", image, "Grey picture of image: white is high; from the ini's folder or absolute");
		v.number("image_width", image_width, above(0), "Its width, laid along east about the origin [m]");
	}
};

/** Depths of the floor on a square grid about the origin, north up: (column i, row j) lies at
 * east = (i - (columns - 1) / 2) resolution, north = -(j - (rows - 1) / 2) resolution. */
struct TDepthGrid
{
	cv::Mat1f depth;	///< [m], at least 2 x 2
	double resolution;	///< [m]
};

/** The grid of the options, the same for the same seed. Throws CError when slope, ripples and boulders alone
 * are higher than `height` allows, or the picture can't be read. */
TDepthGrid makeRelief(const TReliefOptions& relief, const TFloorOptions& floor, uint64_t seed);
}  // namespace posidonia
