#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace posidonia
{
/** A candidate pair of nodes and what became of it: a row of loops.csv. */
struct TLoopRow
{
	std::uint64_t from{0}, to{0};  ///< node ids
	std::string kind;			   ///< "roi", "sequential", "odometry" ...
	std::string status;			   ///< "accepted", "too few matches", "over budget" ...
	int matches{0}, inliers{0};
	double rmse{0};								 ///< of reprojection [px]
	std::optional<Eigen::Isometry3d> T_from_to;	 ///< measured, body frames; always there when accepted

	std::optional<double> weight;  ///< what the robust loss left of the edge, 0 .. 1

	bool accepted() const { return status == "accepted" || status == "accepted on retry"; }
	/** Did the optimiser turn it down in the end? */
	bool rejected() const { return accepted() && weight && *weight < 0.5; }
	/** Was it offered to registration? "over budget" means that its turn never came. */
	bool tried() const { return status != "over budget"; }
	/** Between neighbours in time; anything else is a loop closing. */
	bool consecutive() const { return kind == "sequential" || kind == "odometry"; }
};

/** Header `from,to,kind,status,matches,inliers,rmse_px,tx,ty,tz,qx,qy,qz,qw,weight`, 15 columns, or without
 * the last; the pose may be left empty unless accepted, the weight always, and matches, inliers and rmse_px
 * may be empty where they were not reached (0 then). Throws CError "<file>:<line>: ..." for anything else. A
 * file with the header only has no rows. */
std::vector<TLoopRow> readLoops(const std::string& path);
}  // namespace posidonia
