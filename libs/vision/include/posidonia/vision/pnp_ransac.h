#pragma once

#include <posidonia/vision/key_frame.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace posidonia
{
/** What RANSAC is told. */
struct TRansacOptions
{
	std::string method{"USAC_MSAC"};
	double threshold{3.0};	///< [px]
	double confidence{0.999};
	int max_iterations{2000};
	unsigned seed{1};
};

/** T_a_b by USAC PnP RANSAC: the points [m] of a against the left pixels of b, in the order of the matches.
 * Deterministic by its seed. None when no consensus of at least 6 is found. */
std::optional<Eigen::Isometry3d> ransacPnP(
	const TStereoCamera& camera, const TKeyFrame& a, const TKeyFrame& b,
	const std::vector<std::pair<int, int>>& matches, const TRansacOptions& options);
}  // namespace posidonia
