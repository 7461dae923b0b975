#pragma once

#include <posidonia/apps/experiment.h>
#include <posidonia/apps/run_folder.h>
#include <posidonia/eval/metrics.h>
#include <posidonia/geometry/trajectory.h>

namespace posidonia
{
/** The trajectories of a run folder, T_map_body. */
struct TRunTrajectories
{
	TTrajectory ekf;  ///< ekf.tum: the navigation filter
	TTrajectory odom;  ///< odom.tum: what the graph gets, after the corruptor
	TTrajectory slam;  ///< slam.tum: handed out at each stereo pair, causal
	TTrajectory nodes;	///< nodes.tum: after the last optimisation
};

/** What a run is judged by. */
struct TScoring
{
	TEvaluationOptions evaluation;
	TLoopEvaluationOptions loops;
	TFootprintCamera camera;
	int paper_experiment{0};  ///< 1 or 2: the paper's table to print
};
TScoring scoringOf(const TExperiment& experiment, const TSensorSuite& sensors);

/** Scores a run against the truth file: metric rows of every trajectory and of the loops of `loops_csv`, and writes the
 * pictures of the paper's figure 5 (trajectories.svg, error.svg) into `folder`. Returns the rows and, for the paper's
 * experiments, its table with ours. */
struct TScore
{
	TMetrics metrics;
	std::string text;
};
TScore scoreRun(
	const TScoring& scoring, const TRunTrajectories& run, const std::string& loops_csv, const std::string& truth_file,
	const CRunFolder& folder);
}  // namespace posidonia
