#include <posidonia/apps/CMissionApp.h>
#include <posidonia/apps/mission/mission_plots.h>
#include <posidonia/apps/mission/realtime_pacer.h>
#include <posidonia/apps/progress.h>
#include <posidonia/apps/run_texts.h>
#include <posidonia/apps/world_files.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/trajectory_io.h>
#include <posidonia/obs/geodesy.h>

#include <filesystem>
#include <iostream>

namespace posidonia
{
namespace
{
/** The configuration as used, such that it flies the same from the run folder: the mission's copy lies beside
 * it, the world's pictures have their full paths. */
std::string repeatable(CIniFile ini, const TSimulationOptions& world)
{
	const auto fullPath = [](const std::string& path) { return std::filesystem::absolute(path).string(); };
	ini.set("ClosedLoop.mission=mission.ini");
	if (!world.floor.image.empty()) ini.set("Floor.image=" + fullPath(world.floor.image));
	if (!world.relief.image.empty()) ini.set("Relief.image=" + fullPath(world.relief.image));
	TSensorSuite sensors = TSensorSuite::sparus2();
	TExperiment::load(ini, sensors);
	return ini.dump();
}
}  // namespace

bool CMissionApp::initialize(int argc, const char* const* argv)
{
	CCommandLine line(
		name,
		"Runs a mission in closed loop: the vehicle steers by its own SLAM pose through a simulated sea. "
		"Writes\n"
		"a run folder with the rawlog of everything measured, what was commanded, the graph and the errors.\n"
		"Example: auv-mission -c ini/paper-exp2-closed.ini");
	TCLAP::SwitchArg realtime(
		"", "realtime", "Keep to the clock, and count the missed deadlines", line.cmd());
	TCLAP::SwitchArg json("", "json", "Print the metrics as JSON instead of the summary", line.cmd());
	if (!line.parse(argc, argv)) return false;

	CIniFile ini = line.ini();
	m_sensors = TSensorSuite::sparus2();
	params = TExperiment::load(ini, m_sensors);
	if (line.wantsConfigDump()) {
		std::cout << ini.dump();
		return false;
	}
	findWorldFiles(params.simulation, line);
	if (params.closed_loop.mission.empty())
		throw CError("[ClosedLoop] mission", "is missing", "name a mission file");
	loadMissionFile(line.besideConfig(params.closed_loop.mission));
	m_config = repeatable(ini, params.simulation);
	m_json = json.getValue();
	m_verbosity = m_json ? 0 : line.verbosity();
	m_realtime = realtime.getValue();
	m_title = line.configName();
	m_folder = std::make_unique<CRunFolder>(line.outputDir(), m_title);
	return true;
}

void CMissionApp::loadMissionFile(const std::string& path)
{
	requireFile(path, "name a mission file in [ClosedLoop] mission, absolute or from the ini's folder");
	CIniFile file = CIniFile::fromFile(path);
	const auto& world = params.simulation.world;
	m_mission = loadMission(file, [&](double latitude, double longitude) {
		return Eigen::Vector2d(nedFromGeodetic({latitude, longitude, 0}, world).head<2>());
	});
	file.refuseUnknown();
	m_mission_text = file.dump();
	const auto& start = params.simulation.route.start;
	checkMission(m_mission, params.autopilot.safety, {start[0], start[1]});
}

/** Everything that runs, in the order of its dependencies. */
struct CMissionApp::TLoop
{
	TLoop(const CMissionApp& app, const TExperiment& e, const CRunFolder& folder)
		: slam(
			  e.slam, app.m_sensors, e.makeOdometry(app.m_sensors),
			  std::make_unique<CStereoImageLoader>(folder.file("mission.rawlog")), folder.file("config.ini")),
		  computer(
			  {e.autopilot, e.controller_pose, e.latency.latency, e.closed_loop.endurance * 3600,
			   e.closed_loop.pose_source != "odometry"},
			  app.m_mission, slam, e.slam.node.distance, e.simulation.run.start_time),
		  vehicle(e.simulation, app.m_sensors, e.faults),
		  recorder(folder.file("mission"), app.m_sensors),
		  pictures(folder, e.report.pictures),
		  loop(
			  {e.closed_loop, e.forced_correction, e.simulation.run.start_time,
			   e.simulation.run.save_images == "all", e.simulation.run.save_depth},
			  vehicle, computer, recorder)
	{
	}
	CStereoSlam slam;
	CVehicleComputer computer;
	CSimulatedVehicle vehicle;
	CMissionRecorder recorder;
	CNodePictures pictures;
	CClosedLoop loop;
	TSilencedAtEnd slam_silenced{slam.timer()}, loop_silenced{loop.timer()};
};

namespace
{
/** Where the mission leads the body [m, map]. */
std::vector<Eigen::Vector3d> wayOf(const TMission& mission, const TSimulationOptions& world)
{
	std::vector<Eigen::Vector3d> way;
	const auto& start = world.route.start;
	way.emplace_back(start[0], start[1], start[2]);
	for (const TStep& step : mission.steps) {
		const Eigen::Vector2d at = step.has_end ? step.end : way.back().head<2>();
		way.emplace_back(at.x(), at.y(), step.altitude_mode ? world.floor.depth - step.altitude : step.depth);
	}
	return way;
}

/** The reasons of the abort; empty when there was none. */
std::string abortOf(const std::vector<TControlStep>& steps)
{
	for (const TControlStep& step : steps)
		for (const TMissionEvent& event : step.output.events)
			if (event.kind == EMissionEvent::MISSION_ABORTED) return event.text;
	return {};
}

TTrajectory controllerPoses(const std::vector<TControlStep>& steps)
{
	TTrajectory poses;
	for (const TControlStep& step : steps)
		if (step.feedback.navigation.valid)
			poses.push_back({step.feedback.navigation.stamp, step.feedback.navigation.T_map_body});
	return poses;
}
}  // namespace

void CMissionApp::run()
{
	m_results = {};
	m_results.folder = m_folder->path();
	m_folder->write("config.ini", m_config);
	m_folder->write("mission.ini", m_mission_text);
	writeSensors(m_folder->file("sensors.ini"), m_sensors);
	TLoop loop(*this, params, *m_folder);
	if (loop.vehicle.scene().hasCamera())
		loop.vehicle.scene().requireFloorUnder(wayOf(m_mission, params.simulation));
	const CInterrupt interrupt;	 // to the end: what was run is written whole
	fly(loop, interrupt);
	loop.recorder.finish();
	m_results.rawlog = loop.recorder.rawlog();
	loop.slam.makeExact();
	m_results.trajectories.nodes = loop.slam.nodes();
	m_results.trajectories.control = controllerPoses(m_results.steps);
	m_results.aborted = abortOf(m_results.steps);
	m_results.counts = countsOf(loop.slam);
	writeResults(loop);
	writeWorldFiles(loop);
	score();
	logSummary(loop);
	writeReportFiles(loop);
	finishReport(*m_folder, params.report, m_verbosity);
}

namespace
{
std::string progressText(const TControlStep& step, size_t steps)
{
	if (!step.feedback.navigation.valid) return mrpt::format("%.0f s, no pose yet", step.t);
	return mrpt::format(
		"%.0f s, step %zu of %zu, pose error %.3f m, %d loops", step.t, std::min(step.output.step + 1, steps),
		steps, controlError(step), step.loops);
}
}  // namespace

void CMissionApp::fly(TLoop& loop, const CInterrupt& interrupt)
{
	const auto start = std::chrono::steady_clock::now();  // for the log alone
	CProgress progress("mission", m_verbosity == 0);
	CRealtimePacer pacer(m_realtime, 1 / params.closed_loop.control_rate);
	const double steps = static_cast<double>(m_mission.steps.size());
	const auto remember = [&] {
		rememberCausal(loop.slam, m_results.trajectories);
		loop.pictures.add(loop.slam);
	};
	const auto stops = [&] { return m_results.interrupted = interrupt.requested(); };
	const auto record = [&](const TControlStep& step) {
		m_results.steps.push_back(step);
		progress.update(
			std::min(1.0, static_cast<double>(step.output.step) / steps),
			progressText(step, m_mission.steps.size()));
		pacer.waitFor(step.t);
	};
	loop.loop.run({record, remember, stops});
	m_results.missed_deadlines = pacer.missed();
	m_results.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
	if (m_realtime)
		m_folder->log(
			mrpt::format(
				"%d of %zu deadlines missed, worst %.3f s late", pacer.missed(), m_results.steps.size(),
				pacer.worst()),
			m_verbosity);
}

void CMissionApp::writeResults(TLoop& loop)
{
	writeSlamFiles(*m_folder, loop.slam, m_results.trajectories);
	writeTum(m_folder->file("control.tum"), m_results.trajectories.control);
	m_folder->write("control.csv", controlCsv(m_results.steps));
	m_folder->write("events.csv", eventsCsv(m_results.steps, params.simulation.run.start_time));
	if (!m_results.trajectories.control.empty())
		m_folder->write("mission.svg", plotMissionErrors(m_results.steps));
	m_folder->write("commands.svg", plotCommands(m_results.steps));
	m_folder->write("loop_timings.csv", timingsCsv(loop.loop.timer(), m_results.counts.nodes));
}

void CMissionApp::writeWorldFiles(const TLoop& loop) const
{
	if (!params.simulation.run.overview || !loop.vehicle.scene().hasCamera()) return;
	std::vector<Eigen::Vector3d> way;
	for (const auto& pose : loop.recorder.truth())
		way.push_back(pose.T.translation());
	loop.vehicle.scene().writeOverview(m_folder->file("mission.overview.png"), way);
}

void CMissionApp::score()
{
	const auto append = [&](const TMetrics& rows) {
		m_results.metrics.insert(m_results.metrics.end(), rows.begin(), rows.end());
	};
	append(m_results.counts.metrics());
	const TMetrics mission = missionMetrics(m_results.steps, m_mission);
	append(mission);
	append(jumpMetrics(m_results.steps, params.forced_correction.time));
	if (m_results.counts.nodes > 0) {
		const TScore score = scoreRun(
			scoringOf(params, m_sensors), m_results.trajectories, m_folder->file("loops.csv"),
			m_folder->file("mission.gt.tum"), mission);
		append(score.metrics);
		if (!score.text.empty()) m_folder->log(score.text, m_verbosity);
		m_folder->log(scoreSummary(score.metrics), m_verbosity);
	}
	m_folder->log(missionSummary(m_results.metrics), m_verbosity);
	writeMetricsJson(m_folder->file("metrics.json"), m_results.metrics);
	if (m_json) std::cout << metricsJson(m_results.metrics);
}

void CMissionApp::writeReportFiles(TLoop& loop)
{
	const double duration = m_results.steps.back().t;
	writeMapFiles(*m_folder, loop.slam, loop.pictures.files());
	writeSensorCounts(*m_folder, loop.slam.odometry(), duration);
	writeRunInfo(
		*m_folder, {name, m_title, versionText(), "mission.gt.tum", m_results.interrupted,
					params.simulation.run.start_time, duration, params.simulation.world});
}

void CMissionApp::logSummary(TLoop& loop)
{
	m_folder->log(versionText(), m_verbosity - 1);
	m_folder->log(m_results.counts.text(), m_verbosity);
	m_folder->log(candidateCounts(loop.slam.map().candidates), m_verbosity);
	m_folder->log(speedText(m_results.steps.back().t, m_results.seconds), m_verbosity);
	m_folder->log("stages: " + stagesText({&loop.loop.timer(), &loop.slam.timer()}), m_verbosity);
	if (m_results.interrupted) m_folder->log(interruptedText(), m_verbosity + 1);
	if (!m_results.aborted.empty())
		m_folder->log("mission ABORTED: " + m_results.aborted + " (events.csv says when)", m_verbosity + 1);
	m_folder->log(navigationText(loop.slam.odometry()), m_verbosity - 1);
	m_folder->log("run folder: " + m_folder->path(), m_verbosity);
}
}  // namespace posidonia
