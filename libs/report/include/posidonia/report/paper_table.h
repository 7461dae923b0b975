#pragma once

#include <limits>
#include <string>
#include <vector>

namespace posidonia
{
/** A row of the paper's Tables 2 and 3. */
struct TPaperRow
{
	std::string input;	   ///< "Odometry", "SLAM" ...
	double length{0};	   ///< Traj. Dist. [m]
	double mean_error{0};  ///< Trans. ME: mean 3D error, unaligned [m]; NaN shows as "-" (the truth has none)
	/** Of a vehicle that steered by it: mean true distance from the last point while it keeps station there,
	 * mean true cross-track error on the legs [m]; NaN shows as "-". */
	double end_error{std::numeric_limits<double>::quiet_NaN()};
	double cross_track{std::numeric_limits<double>::quiet_NaN()};
};

/** The paper's Table 2 (experiment 1) or 3 (experiment 2) with our rows under it, for a terminal.
 * The columns of steering are there when any row has them.
 * Throws CError for another experiment. */
std::string paperTable(int experiment, const std::vector<TPaperRow>& ours);
}  // namespace posidonia
