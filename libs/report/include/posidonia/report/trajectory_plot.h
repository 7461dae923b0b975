#pragma once

#include <posidonia/eval/loops_file.h>
#include <posidonia/geometry/trajectory.h>

#include <string>
#include <utility>
#include <vector>

namespace posidonia
{
/** A line between two positions (x, y, z) in map [m]. */
using TSegment = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

/** The upper half of the paper's figure 5. A trajectory left empty is left out. */
struct TTrajectoryPlot
{
	std::string title;
	TTrajectory odometry, truth, slam;	///< T_map_body
	std::vector<TSegment> loops, rejected_loops;
};

/** x (north) horizontally, y (east) vertically, as the paper plots them, at equal scale, in metres.
 * Throws CError when there is nothing to draw. */
std::string plotTrajectories(const TTrajectoryPlot& plot);

/** The loop closings that were accepted and not turned down later (no sequential or odometry edges) between
 * `nodes`, whose index is their id. Between SLAM nodes they are short where SLAM is good; between the
 * odometry's poses at the nodes they show the drift that they took away. Throws CError for an id beyond the
 * nodes. */
std::vector<TSegment> loopSegments(const std::vector<TLoopRow>& rows, const TTrajectory& nodes);
/** Those of them that the optimiser turned down. */
std::vector<TSegment> rejectedLoopSegments(const std::vector<TLoopRow>& rows, const TTrajectory& nodes);
}  // namespace posidonia
