#pragma once

#include <posidonia/vision/features.h>

#include <utility>
#include <vector>

namespace posidonia
{
/** Pairs (left, right) of key points that are each other's nearest descriptor among those in the same row
 * band (the tolerance grows with the key points' scale), of like scale, with a disparity in [min, max] px. */
std::vector<std::pair<int, int>> matchRows(
	const TFeatures& left, const TFeatures& right, const TFeatureOptions& options, double min_disparity,
	double max_disparity);
}  // namespace posidonia
