#pragma once

#include <posidonia/eval/metrics.h>

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

/** Our rows from those of a run's metrics.json ("odom.length", "nodes.ate.unaligned.mean", ...): truth,
 * odometry, final nodes, causal poses and, of a closed loop, the pose in control. Throws CError when the run
 * was not scored. */
std::vector<TPaperRow> paperRows(const TMetrics& metrics);

/** The table as cells. */
struct TTextRows
{
	std::string title;
	std::vector<std::string> header;
	std::vector<std::vector<std::string>> rows;
};

/** The paper's Table 2 (experiment 1) or 3 (experiment 2) with our rows under it.
 * The columns of steering are there when any row has them.
 * Throws CError for another experiment. */
TTextRows paperTableRows(int experiment, const std::vector<TPaperRow>& ours);
/** The same for a terminal. */
std::string paperTable(int experiment, const std::vector<TPaperRow>& ours);
}  // namespace posidonia
