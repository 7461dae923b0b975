#include <posidonia/apps/CEvalApp.h>
#include <posidonia/apps/score_texts.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/trajectory_io.h>

#include <filesystem>
#include <iostream>
#include <set>

namespace fs = std::filesystem;

namespace posidonia
{
namespace
{
/** One trajectory of a run folder; empty when it is not there. */
TTrajectory trajectoryIn(const std::string& folder, const std::string& name)
{
	const std::string path = folder + "/" + name + ".tum";
	return fs::exists(path) ? readTum(path) : TTrajectory();
}

TRunScores scoresOfFolder(const std::string& folder, const TScoring& scoring, const TTrajectory& truth)
{
	TRunTrajectories run;
	run.ekf = trajectoryIn(folder, "ekf");
	run.odom = trajectoryIn(folder, "odom");
	run.slam = trajectoryIn(folder, "slam");
	run.nodes = trajectoryIn(folder, "nodes");
	run.control = trajectoryIn(folder, "control");
	if (run.ekf.empty() && run.odom.empty() && run.slam.empty() && run.nodes.empty())
		throw CError(
			folder, "holds none of nodes.tum, slam.tum, odom.tum, ekf.tum",
			"give a run folder or a trajectory file");
	std::vector<TLoopRow> loops;
	const bool has_loops = fs::exists(folder + "/loops.csv");
	if (has_loops) loops = readLoops(folder + "/loops.csv");
	return evaluateTrajectories(scoring, run, has_loops ? &loops : nullptr, truth);
}

TRunScores scoresOfFile(const std::string& file, const TScoring& scoring, const TTrajectory& truth)
{
	const std::string stem = fs::path(file).stem().string();
	TRunScores scores;
	scores.trajectories.push_back({stem, evaluateRun(stem, readTrajectory(file), truth, scoring.evaluation)});
	return scores;
}

std::string withoutSlash(std::string path)
{
	while (path.size() > 1 && path.back() == '/')
		path.pop_back();
	return path;
}

void requireInput(const std::string& path)
{
	if (!fs::exists(path))
		throw CError(path, "no such file or folder", "give a trajectory or a run folder with -i");
}
}  // namespace

bool CEvalApp::initialize(int argc, const char* const* argv)
{
	CCommandLine line(
		name,
		"Errors of trajectories (TUM, KITTI or EuRoC files) or of run folders against the true trajectory: "
		"ATE, RPE,\n"
		"lengths and, for run folders, precision and recall of the loops. Camera, floor and limits come from "
		"-c or else\n"
		"from the run folder itself. With --summary: median and worst of several runs' metrics.json.\n"
		"Examples: auv-eval -i runs/latest -g data/paper-exp2.gt.tum\n"
		"          auv-eval --summary -i runs/seed1 -i runs/seed2 -i runs/seed3",
		"Folder for metrics.json and metrics.csv (with every alignment)");
	auto& cmd = line.cmd();
	TCLAP::MultiArg<std::string> inputs(
		"i", "input", "Trajectory file or run folder; may be repeated", false, "PATH", cmd);
	TCLAP::ValueArg<std::string> truth(
		"g", "ground-truth", "True trajectory: TUM, KITTI or EuRoC", false, "", "FILE", cmd);
	TCLAP::ValueArg<std::string> align(
		"", "align", "Alignments in the table: none, origin, yaw_position, se3 or all (default)", false,
		"all", "NAME", cmd);
	TCLAP::SwitchArg json("", "json", "Print every row as JSON instead of tables", cmd);
	TCLAP::SwitchArg summary(
		"", "summary", "Median and worst over the runs of -i, from their metrics.json", cmd);
	if (!line.parse(argc, argv)) return false;

	m_alignments = alignmentsOf(align.getValue());
	if (line.wantsConfigDump()) {
		CIniFile ini = line.ini();
		TSensorSuite sensors = TSensorSuite::sparus2();
		TExperiment::load(ini, sensors);
		std::cout << ini.dump();
		return false;
	}
	if (inputs.getValue().empty())
		throw CUsageError("-i/--input", "is missing", "give a trajectory file or a run folder");
	if (summary.getValue() && truth.isSet())
		throw CUsageError("--summary", "needs no -g", "the runs' metrics.json were made with the truth");
	if (!summary.getValue() && !truth.isSet())
		throw CUsageError("-g/--ground-truth", "is missing", "give the true trajectory");
	m_summary = summary.getValue();
	m_json = json.getValue();
	m_truth = truth.getValue();
	m_output = line.outputDir();
	if (!m_summary) requireFile(m_truth, "give the true trajectory with -g/--ground-truth");
	for (const auto& path : inputs.getValue())
		m_inputs.push_back(inputOf(path, line));
	nameInputs();
	refuseOverwritingInputs();
	return true;
}

CEvalApp::TInput CEvalApp::inputOf(const std::string& given, const CCommandLine& line) const
{
	const std::string path = withoutSlash(given);
	requireInput(path);
	if (m_summary) return {path, path, {}};
	const bool own_sensors = fs::exists(path + "/sensors.ini");
	TSensorSuite sensors = own_sensors ? readSensors(path + "/sensors.ini") : TSensorSuite::sparus2();
	CIniFile ini = line.ini(path + "/config.ini");
	const TExperiment experiment = TExperiment::load(ini, sensors);
	return {path, path, scoringOf(experiment, sensors)};
}

void CEvalApp::nameInputs()
{
	std::set<std::string> names;
	for (const auto& input : m_inputs)
		names.insert(fs::path(input.path).filename().string());
	if (names.size() != m_inputs.size()) return;  // two end alike: their paths stay
	for (auto& input : m_inputs)
		input.name = fs::path(input.path).filename().string();
}

void CEvalApp::refuseOverwritingInputs() const
{
	for (const auto& input : m_inputs)
		if (!m_output.empty() && fs::is_directory(input.path) && fs::exists(m_output) &&
			fs::equivalent(input.path, m_output))
			throw CUsageError(
				"-o " + m_output, "is the run itself, whose metrics.json would be lost",
				"give another folder");
}

void CEvalApp::run()
{
	m_results = {};
	if (m_summary)
		summarizeRuns();
	else
		evaluate();
}

void CEvalApp::evaluate()
{
	const TTrajectory truth = readTrajectory(m_truth);
	std::string table;
	for (const auto& input : m_inputs) {
		const TRunScores scores = fs::is_directory(input.path)
									  ? scoresOfFolder(input.path, input.scoring, truth)
									  : scoresOfFile(input.path, input.scoring, truth);
		const bool several = m_inputs.size() > 1;
		table += (table.empty() ? "" : "\n") + (several ? input.name + "\n\n" : "") +
				 scoresText(scores, m_alignments);
		for (TMetric row : scores.metrics()) {
			if (several) row.what = input.name + "." + row.what;
			m_results.metrics.push_back(row);
		}
	}
	hand(table);
}

void CEvalApp::summarizeRuns()
{
	std::vector<TRunMetrics> runs;
	for (const auto& input : m_inputs)
		runs.push_back(readRunMetrics(input.path));
	m_results.summary = posidonia::summarize(runs);
	m_results.metrics = m_results.summary->metrics();
	hand(std::to_string(runs.size()) + " runs\n" + m_results.summary->text());
}

void CEvalApp::hand(const std::string& table) const
{
	std::cout << (m_json ? metricsJson(m_results.metrics) : table);
	if (m_output.empty()) return;
	makeFolder(m_output);
	writeMetricsJson(m_output + "/metrics.json", m_results.metrics);
	writeMetricsCsv(m_output + "/metrics.csv", m_results.metrics);
}
}  // namespace posidonia
