#pragma once

#include <posidonia/apps/experiment.h>
#include <posidonia/eval/metrics.h>
#include <posidonia/geometry/trajectory.h>

#include <optional>

namespace posidonia
{
/** The trajectories of a run folder, T_map_body. */
struct TRunTrajectories
{
	TTrajectory ekf;	///< ekf.tum: the navigation filter
	TTrajectory odom;	///< odom.tum: what the graph gets, after the corruptor
	TTrajectory slam;	///< slam.tum: handed out at each stereo pair, causal
	TTrajectory nodes;	///< nodes.tum: after the last optimisation
	/** control.tum: what the controllers of a closed loop were given, causal and rate-limited; else empty. */
	TTrajectory control{};
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

/** How the trajectories of a run compare with the truth, and its loops. */
struct TRunScores
{
	struct TNamed
	{
		std::string name;
		TRunEvaluation evaluation;
	};
	std::vector<TNamed> trajectories;  ///< Those that are there, in the order nodes, slam, odom, ekf, control
	std::optional<TLoopEvaluation> loops;

	/** The evaluation of `name`; null when it is not there. */
	const TRunEvaluation* find(const std::string& name) const;
	/** Every row: "nodes.ate.unaligned.mean" ... "loops.accepted" ... */
	TMetrics metrics() const;
};

/** Empty trajectories are left out; odom counts at the nodes' stamps where there are nodes, so that both have
 * the same poses. `loops`: rows of loops.csv, judged where there are nodes. Throws CError when nothing can be
 * associated. */
TRunScores evaluateTrajectories(
	const TScoring& scoring, const TRunTrajectories& run, const std::vector<TLoopRow>* loops,
	const TTrajectory& truth);

/** Scores a run against the truth file: metric rows of every trajectory and of the loops of `loops_csv`,
 * and, for the paper's experiments, its table with ours. @param mission rows "mission.*" of a vehicle that
 * steered by its pose, for the table */
struct TScore
{
	TMetrics metrics;
	std::string text;
};
TScore scoreRun(
	const TScoring& scoring, const TRunTrajectories& run, const std::string& loops_csv,
	const std::string& truth_file, const TMetrics& mission = {});
}  // namespace posidonia
