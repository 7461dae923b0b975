#pragma once

#include <posidonia/base/options.h>

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace posidonia
{
/** Section [Floor]: a flat sea floor with a grey texture. */
struct TFloorOptions
{
	double depth{6.0};
	std::string texture{"photo"}, image{"textures/noaa_reef.jpg"};
	double image_width{30}, blend{0.8};
	double extent_north{30}, extent_east{40}, resolution{0.005};
	double margin{0};
	double brightness{115}, contrast{1};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("depth", depth, above(0), "Depth of the flat floor [m] (paper: 3.5 + 2.5)");
		v.choice("texture", texture, {"photo", "sand", "rock", "tiled"}, "What the floor looks like");
		v.text("image", image, "Picture of photo and tiled, from the ini's folder or absolute");
		v.number("image_width", image_width, above(0), "The picture's width, laid along east [m]");
		v.number(
			"blend", blend, above(0),
			"Width of the picture's border that fades into the procedural floor [m]");
		v.number("extent_north", extent_north, between(1, 400), "Floor about the origin, along north [m]");
		v.number("extent_east", extent_east, between(1, 400), "Floor about the origin, along east [m]");
		v.number(
			"margin", margin, atLeast(0),
			"The texture must reach this much farther than the camera sees from the route [m]");
		v.number("resolution", resolution, between(0.0005, 1), "Size of a texture pixel [m]");
		v.number("brightness", brightness, between(0, 255), "Mean grey of sand and rock");
		v.number(
			"contrast", contrast, atLeast(0), "Factor on the grey contrast of any texture about its mean");
	}
};

/** The texture and its mip levels. Pixel centres at whole numbers: pixel (column i, row j) of level 0 lies at
 * east = (i - (columns - 1) / 2) resolution, north = -(j - (rows - 1) / 2) resolution (north up).
 * Level n averages 2^n x 2^n pixels, so its coordinates are (c + 0.5) / 2^n - 0.5. */
class CFloorTexture
{
   public:
	/** Generates the texture of `options`, the same for the same seed. Throws CError when the picture can't
	 * be read. */
	CFloorTexture(const TFloorOptions& options, uint64_t seed);
	/** A given level 0 (CV_8UC1); rows and columns are cut to a multiple of 2^(levels-1). */
	CFloorTexture(const cv::Mat& level0, double resolution);

	const std::vector<cv::Mat>& levels() const { return m_levels; }
	double resolution() const { return m_resolution; }	///< Of level 0 [m/px]
	/** (column, row) of level 0 at (north, east) [m]. */
	Eigen::Vector2d pixelAt(const Eigen::Vector2d& north_east) const;

   private:
	void build(const cv::Mat& level0);
	double m_resolution;
	std::vector<cv::Mat> m_levels;
};

/** Feature-poor sand and high-contrast rock, CV_8UC1; pixels are `resolution` [m] wide. */
cv::Mat proceduralSand(cv::Size size, double resolution, uint64_t seed);
cv::Mat proceduralRock(cv::Size size, double resolution, uint64_t seed);
/** A floor of `size` with the spectrum (contrast by octave) and mean of `sample`, without any of its pixels.
 * CV_8UC1. */
cv::Mat proceduralLike(const cv::Mat& sample, cv::Size size, uint64_t seed);
}  // namespace posidonia
