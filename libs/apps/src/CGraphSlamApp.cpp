#include <posidonia/apps/CGraphSlamApp.h>
#include <posidonia/apps/progress.h>
#include <posidonia/base/files.h>
#include <posidonia/graphslam/decider_registry.h>

#include <chrono>
#include <iostream>

namespace posidonia
{
using mrpt::obs::CObservationStereoImages;

bool CGraphSlamApp::initialize(int argc, const char* const* argv)
{
	CCommandLine line(
		name,
		"Stereo graph-SLAM on a rawlog: writes a run folder with the corrected trajectory, the graph, every "
		"loop\n"
		"candidate and, where NAME.gt.tum lies beside the rawlog or -g is given, the errors.\n"
		"Example: auv-graphslam -c ini/paper-exp2.ini -r data/paper-exp2.rawlog");
	auto& cmd = line.cmd();
	CReplayCommand replay(line);
	TCLAP::ValueArg<std::string> nodes(
		"n", "node-decider", "Overrides [Slam] node_decider", false, "", "NAME", cmd);
	TCLAP::ValueArg<std::string> edges(
		"e", "edge-deciders", "Overrides [Slam] edge_deciders", false, "", "NAMES", cmd);
	TCLAP::ValueArg<std::string> optimizer(
		"", "optimizer", "Overrides [Slam] optimizer", false, "", "NAME", cmd);
	TCLAP::SwitchArg json("", "json", "Print the metrics as JSON instead of the summary", cmd);
	TCLAP::SwitchArg list("", "list-deciders", "Print deciders and optimisers, and stop", cmd);
	if (!line.parse(argc, argv)) return false;
	if (list.getValue()) {
		std::cout << listDeciders();
		return false;
	}

	CIniFile ini = line.ini();
	if (nodes.isSet()) ini.set("Slam.node_decider=" + nodes.getValue());
	if (edges.isSet()) ini.set("Slam.edge_deciders=" + edges.getValue());
	if (optimizer.isSet()) ini.set("Slam.optimizer=" + optimizer.getValue());
	if (!replay.load(ini, m_input, params)) return false;
	m_json = json.getValue();
	if (m_json) m_input.verbosity = 0;
	m_folder = std::make_unique<CRunFolder>(line.outputDir(), m_input.name());
	return true;
}

void CGraphSlamApp::run()
{
	const auto start = std::chrono::steady_clock::now();  // for the log alone
	m_results = {};
	m_results.folder = m_folder->path();
	m_folder->write("config.ini", m_input.config);
	writeSensors(m_folder->file("sensors.ini"), m_input.sensors);
	CRawlogReader reader(m_input.rawlog);
	CStereoSlam slam(
		params.slam, m_input.sensors, params.makeOdometry(m_input.sensors),
		std::make_unique<CStereoImageLoader>(m_input.rawlog), m_folder->file("config.ini"));
	const TSilencedAtEnd silenced{slam.timer()};
	CNodePictures pictures(*m_folder, params.report.pictures);
	const CInterrupt interrupt;	 // to the end: what was run is written whole
	replay(slam, reader, pictures, interrupt);
	slam.makeExact();
	collect(slam, reader);
	writeSlamFiles(*m_folder, slam, m_results.trajectories);
	logSummary(slam, reader, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
	if (!m_input.truth.empty()) score(slam);
	writeMetricsJson(m_folder->file("metrics.json"), m_results.metrics);
	if (m_json) std::cout << metricsJson(m_results.metrics);
	m_folder->log("run folder: " + m_folder->path(), m_input.verbosity);
	writeReportFiles(slam, pictures);
	finishReport(*m_folder, params.report, m_input.verbosity);
}

void CGraphSlamApp::writeReportFiles(const CStereoSlam& slam, CNodePictures& pictures)
{
	const auto& poses = m_results.trajectories.slam;
	const double start = poses.front().stamp, end = poses.back().stamp;
	writeMapFiles(*m_folder, slam, pictures.files());
	writeSensorCounts(*m_folder, slam.odometry(), end - start);
	writeRunInfo(
		*m_folder, {name, m_input.name(), versionText(), copyTruth(*m_folder, m_input.truth, start, end),
					m_results.interrupted, start, end - start, params.simulation.world});
}

void CGraphSlamApp::replay(
	CStereoSlam& slam, CRawlogReader& reader, CNodePictures& pictures, const CInterrupt& interrupt)
{
	CProgress progress("graph-SLAM", m_input.verbosity == 0);
	while (const auto observation = reader.next()) {
		m_results.interrupted = interrupt.requested();
		if (m_results.interrupted) return;
		slam.add(observation);
		rememberCausal(slam, m_results.trajectories);
		pictures.add(slam);
		if (!IS_CLASS(*observation, CObservationStereoImages) || slam.map().nodeCount() == 0) continue;
		progress.update(
			reader.progress(),
			mrpt::format("%d nodes, %zu edges", slam.map().nodeCount(), slam.map().edges().size()));
	}
	progress.update(1);
}

void CGraphSlamApp::collect(const CStereoSlam& slam, const CRawlogReader& reader)
{
	if (slam.map().nodeCount() == 0 && m_results.interrupted)
		throw CError(reader.path(), "interrupted before the first node was made", "let it run longer");
	if (slam.map().nodeCount() == 0)
		throw CError(
			reader.path(),
			"no node was made: " +
				std::string(
					slam.odometry().ready() ? "it holds no stereo pair" : "the odometry never became ready"),
			"check its sensors with rawlog-edit --info, and [InitialPose]");
	m_results.trajectories.nodes = slam.nodes();
	m_results.counts = countsOf(slam);
	m_results.metrics = m_results.counts.metrics();
}

void CGraphSlamApp::score(const CStereoSlam&)
{
	const TScore score = scoreRun(
		scoringOf(params, m_input.sensors), m_results.trajectories, m_folder->file("loops.csv"),
		m_input.truth);
	m_results.metrics.insert(m_results.metrics.end(), score.metrics.begin(), score.metrics.end());
	if (!score.text.empty()) m_folder->log(score.text, m_input.verbosity);
	m_folder->log(scoreSummary(score.metrics), m_input.verbosity);
	m_folder->log("truth: " + m_input.truth, m_input.verbosity - 1);
}

void CGraphSlamApp::logSummary(const CStereoSlam& slam, const CRawlogReader& reader, double seconds)
{
	m_folder->log(versionText(), m_input.verbosity - 1);
	if (m_results.interrupted) m_folder->log(interruptedText(), m_input.verbosity + 1);
	const std::string losses = replayLosses(reader);
	if (!losses.empty()) m_folder->log(losses, m_input.verbosity + 1);	// even when quiet
	m_folder->log(m_results.counts.text(), m_input.verbosity);
	m_folder->log(candidateCounts(slam.map().candidates), m_input.verbosity);
	const auto& poses = m_results.trajectories.slam;
	m_folder->log(speedText(poses.back().stamp - poses.front().stamp, seconds), m_input.verbosity);
	m_folder->log("stages: " + stagesText({&slam.timer()}), m_input.verbosity);
	m_folder->log(navigationText(slam.odometry()), m_input.verbosity - 1);
}
}  // namespace posidonia
