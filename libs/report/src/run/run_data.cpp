#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/base/ini_file.h>
#include <posidonia/eval/trajectory_io.h>
#include <posidonia/obs/sensor_suite.h>
#include <posidonia/report/run_data.h>

#include <filesystem>

namespace fs = std::filesystem;

namespace posidonia
{
namespace
{
/** Calls read(path) where the folder has the file. */
template <class F>
void ifThere(const TRunData& run, const std::string& name, F&& read)
{
	if (fs::exists(run.file(name))) read(run.file(name));
}

void readTrajectories(TRunData& run)
{
	for (const char* name : {"ekf", "odom", "slam", "nodes", "control"})
		ifThere(run, std::string(name) + ".tum", [&](const std::string& path) {
			if (fs::file_size(path) > 0) run.trajectories[name] = readTum(path);
		});
	if (!run.info.truth.empty()) run.trajectories["truth"] = readTum(run.file(run.info.truth));
}

/** The key of [Report] that the page needs of the configuration. */
struct TPaperKey
{
	int experiment{0};
	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.integer("paper_experiment", experiment, between(0, 2), "The paper's table to show");
	}
};

void readCamera(TRunData& run, const std::string& path)
{
	const TSensorSuite sensors = readSensors(path);
	if (sensors.stereo.empty()) return;
	const TStereoSpec& rig = sensors.stereo.begin()->second;
	run.camera = TRunData::TCamera{rig.camera, rig.T_body_sensor()};
}

void readTexts(TRunData& run)
{
	ifThere(run, "config.ini", [&](const std::string& path) {
		run.config = readFileText(path);
		run.paper_experiment = CIniFile::fromFile(path).load<TPaperKey>("Report").experiment;
	});
	ifThere(run, "mission.ini", [&](const std::string& path) { run.mission = readFileText(path); });
	ifThere(run, "run.log", [&](const std::string& path) { run.log = readFileText(path); });
}
}  // namespace

const TTrajectory& TRunData::trajectory(const std::string& name) const
{
	static const TTrajectory kNone;
	const auto found = trajectories.find(name);
	return found == trajectories.end() ? kNone : found->second;
}

TRunData readRun(const std::string& folder)
{
	TRunData run;
	run.folder = folder;
	requireFile(run.file("run.json"), "give the folder of a run of auv-graphslam, auv-mission or auv-ekf");
	run.info = readRunInfo(run.file("run.json"));
	readTrajectories(run);
	readTexts(run);
	ifThere(run, "poses.csv", [&](const std::string& path) { run.nodes = readNodes(path); });
	ifThere(run, "loops.csv", [&](const std::string& path) { run.loops = readLoops(path); });
	ifThere(run, "matches.csv", [&](const std::string& path) {
		for (TMatchesRow& row : readMatches(path))
			run.matches[{row.from, row.to}] = std::move(row);
	});
	ifThere(run, "metrics.json", [&](const std::string& path) { run.metrics = readMetricsJson(path); });
	ifThere(run, "timings.csv", [&](const std::string& path) { run.timings["SLAM"] = readTimings(path); });
	ifThere(run, "loop_timings.csv", [&](const std::string& path) {
		run.timings["closed loop"] = readTimings(path);
	});
	ifThere(run, "sensors.csv", [&](const std::string& path) { run.sensors = readSensorRows(path); });
	ifThere(run, "events.csv", [&](const std::string& path) { run.events = readEvents(path); });
	ifThere(run, "control.csv", [&](const std::string& path) { run.control = readNumberTable(path); });
	ifThere(run, "sensors.ini", [&](const std::string& path) { readCamera(run, path); });
	return run;
}
}  // namespace posidonia
