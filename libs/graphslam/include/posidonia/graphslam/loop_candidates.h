#pragma once

#include <posidonia/geometry/stereo_camera.h>
#include <posidonia/graphslam/slam_map.h>
#include <posidonia/graphslam/slam_options.h>

#include <vector>

namespace posidonia
{
/** A node to be registered against the newest one. */
struct TCandidate
{
	int node{0};
	/** Predicted share of the newest picture that the candidate's shows, 0 to 1; of a pair that is only
	 * possible: with the newest at its best place within the uncertainty. */
	double overlap{0};
	bool only_possible{false};	///< Too little overlap at the predicted poses
};

/** Nodes inside the sphere of radius `options.radius` round node j (paper sec. 3.2, "Region of Interest"),
 * the latest min_node_gap left out, with their predicted overlap; best overlap first, ties to the older node.
 * Where the pair's place is uncertain the sphere grows to `options.sigmas` times that, up to
 * `options.radius_max`, and pairs whose pictures may share enough within it come last, the nearest first.
 * @param sigma of each node's horizontal place seen from j [m]; empty: certain */
std::vector<TCandidate> candidatesInRoi(
	const CSlamMap& map, int j, const TRoiOptions& options, const TStereoCamera& camera,
	const Eigen::Isometry3d& T_body_camera, const std::vector<double>& sigma = {});

/** Share of the picture of camera j, at the range `depth` [m] of the floor, that falls into the picture of
 * camera i. */
double predictedOverlap(const TStereoCamera& camera, const Eigen::Isometry3d& T_cam_i_cam_j, double depth);

/** Median depth of a key frame's points [m]; 0 without points. */
double medianDepth(const TKeyFrame& key_frame);
}  // namespace posidonia
