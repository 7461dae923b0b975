#include <posidonia/apps/scoring.h>
#include <posidonia/eval/loop_evaluation.h>
#include <posidonia/eval/trajectory_io.h>
#include <posidonia/report/paper_table.h>

namespace posidonia
{
TScoring scoringOf(const TExperiment& experiment, const TSensorSuite& sensors)
{
	TScoring scoring{
		experiment.evaluation, experiment.loop_evaluation, {}, experiment.report.paper_experiment};
	if (!sensors.stereo.empty()) {
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
	for (const auto& node : nodes) {
		while (k < trajectory.size() && trajectory[k].stamp < node.stamp)
			k++;
		if (k < trajectory.size()) picked.push_back(trajectory[k]);
	}
	return picked;
}

std::map<std::uint64_t, Eigen::Isometry3d> trueNodePoses(const TAssociation& nodes)
{
	std::map<std::uint64_t, Eigen::Isometry3d> poses;
	for (const auto& pair : nodes)
		poses[pair.index] = pair.T_truth_body;
	return poses;
}

}  // namespace

const TRunEvaluation* TRunScores::find(const std::string& name) const
{
	for (const auto& t : trajectories)
		if (t.name == name) return &t.evaluation;
	return nullptr;
}

TMetrics TRunScores::metrics() const
{
	TMetrics rows;
	const auto append = [&](const TMetrics& more) { rows.insert(rows.end(), more.begin(), more.end()); };
	for (const auto& t : trajectories)
		append(t.evaluation.metrics);
	if (loops) append(loopMetrics("loops", *loops));
	return rows;
}

TRunScores evaluateTrajectories(
	const TScoring& scoring, const TRunTrajectories& run, const std::vector<TLoopRow>* loops,
	const TTrajectory& truth)
{
	TRunScores scores;
	const auto evaluate = [&](const char* name, const TTrajectory& t) {
		if (!t.empty())
			scores.trajectories.push_back({name, evaluateRun(name, t, truth, scoring.evaluation)});
	};
	evaluate("nodes", run.nodes);
	evaluate("slam", run.slam);
	evaluate("odom", run.nodes.empty() ? run.odom : atNodes(run.odom, run.nodes));
	evaluate("ekf", run.ekf);
	evaluate("control", run.control);
	if (const auto* nodes = scores.find("nodes"); nodes && loops)
		scores.loops = evaluateLoops(*loops, trueNodePoses(nodes->poses), scoring.camera, scoring.loops);
	return scores;
}

TScore scoreRun(
	const TScoring& scoring, const TRunTrajectories& run, const std::string& loops_csv,
	const std::string& truth_file, const TMetrics& mission)
{
	const TTrajectory truth = readTum(truth_file);
	const auto loops = readLoops(loops_csv);
	const TRunScores scores = evaluateTrajectories(scoring, run, &loops, truth);
	TScore score{scores.metrics(), {}};
	if (scoring.paper_experiment == 0) return score;
	TMetrics rows = score.metrics;
	rows.insert(rows.end(), mission.begin(), mission.end());
	score.text = paperTable(scoring.paper_experiment, paperRows(rows));
	return score;
}
}  // namespace posidonia
