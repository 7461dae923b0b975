#include <posidonia/apps/scoring.h>
#include <posidonia/eval/loop_evaluation.h>
#include <posidonia/eval/trajectory_io.h>
#include <posidonia/report/error_plot.h>
#include <posidonia/report/paper_table.h>
#include <posidonia/report/trajectory_plot.h>

#include <limits>

namespace posidonia
{
TScoring scoringOf(const TExperiment& experiment, const TSensorSuite& sensors)
{
	TScoring scoring{experiment.evaluation, experiment.loop_evaluation, {}, experiment.report.paper_experiment};
	if (!sensors.stereo.empty())
	{
		const TStereoSpec& rig = sensors.stereo.begin()->second;
		scoring.camera = {rig.camera, rig.T_body_sensor(), experiment.simulation.floor.depth};
	}
	return scoring;
}

namespace
{
/** The poses of `trajectory` at the stamps of `nodes` (it has them all: nodes are made at stereo pairs). */
TTrajectory atNodes(const TTrajectory& trajectory, const TTrajectory& nodes)
{
	TTrajectory picked;
	size_t k = 0;
	for (const auto& node : nodes)
	{
		while (k < trajectory.size() && trajectory[k].stamp < node.stamp) k++;
		if (k < trajectory.size()) picked.push_back(trajectory[k]);
	}
	return picked;
}

std::map<std::uint64_t, Eigen::Isometry3d> trueNodePoses(const TAssociation& nodes)
{
	std::map<std::uint64_t, Eigen::Isometry3d> poses;
	for (const auto& pair : nodes) poses[pair.index] = pair.T_truth_body;
	return poses;
}

void append(TMetrics& rows, const TMetrics& more) { rows.insert(rows.end(), more.begin(), more.end()); }

std::string tableText(int experiment, const TRunEvaluation& odom, const TRunEvaluation& nodes, const TRunEvaluation& slam)
{
	if (experiment == 0) return {};
	const auto mean = [](const TRunEvaluation& e) { return e.absolute[0].translation.mean; };
	return paperTable(
		experiment, {{"Ground truth", nodes.truth_length, std::numeric_limits<double>::quiet_NaN()},
						{"Odometry", odom.length, mean(odom)},
						{"Posidonia (nodes)", nodes.length, mean(nodes)},
						{"Posidonia (causal)", slam.length, mean(slam)}});
}
}  // namespace

TScore scoreRun(
	const TScoring& scoring, const TRunTrajectories& run, const std::string& loops_csv, const std::string& truth_file,
	const CRunFolder& folder)
{
	const TTrajectory truth = readTum(truth_file);
	const auto evaluate = [&](const char* prefix, const TTrajectory& t) {
		return evaluateRun(prefix, t, truth, scoring.evaluation);
	};
	const TRunEvaluation nodes = evaluate("nodes", run.nodes), slam = evaluate("slam", run.slam),
						 odom = evaluate("odom", atNodes(run.odom, run.nodes)), ekf = evaluate("ekf", run.ekf);
	TScore score;
	for (const auto* e : {&nodes, &slam, &odom, &ekf}) append(score.metrics, e->metrics);
	const auto loops = readLoops(loops_csv);
	append(score.metrics,
		loopMetrics("loops", evaluateLoops(loops, trueNodePoses(nodes.poses), scoring.camera, scoring.loops)));

	const std::string title = scoring.paper_experiment ? "Experiment " + std::to_string(scoring.paper_experiment) : "Survey";
	folder.write("trajectories.svg", plotTrajectories({title, run.odom, truth, run.nodes, loopSegments(loops, run.nodes)}));
	folder.write("error.svg", plotErrors({title, odom.absolute[0].poses, nodes.absolute[0].poses}));
	score.text = tableText(scoring.paper_experiment, odom, nodes, slam);
	return score;
}
}  // namespace posidonia
