#pragma once

#include <posidonia/vision/feature_options.h>

#include <opencv2/core.hpp>
#include <vector>

namespace posidonia
{
/** Key points of one image with a descriptor row each. */
struct TFeatures
{
	std::vector<cv::KeyPoint> key_points;
	cv::Mat descriptors;  ///< CV_8U

	/** log2 of a key point's size over the detector's smallest, >= 0. */
	double octave(size_t i) const { return octaves[i]; }
	std::vector<double> octaves;
};

/** The strongest key points of an 8-bit grey image, spread over the grid, sorted by row then column; the same
 * whatever the number of threads. */
TFeatures detectFeatures(const cv::Mat& image, const TFeatureOptions& options);

/** Are this detector's descriptors compared by Hamming distance? */
bool isBinaryDetector(const std::string& detector);

/** Indices of at most `n` key points: first the strongest of each grid cell up to the cell's share, then the
 * strongest of the rest; in row-major order of position. Of key points at one position all or none differ
 * only by angle. */
std::vector<int> spreadOverGrid(
	const std::vector<cv::KeyPoint>& key_points, cv::Size image, int columns, int rows, int n);
}  // namespace posidonia
