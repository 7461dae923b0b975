#include <posidonia/apps/CGraphSlamApp.h>
#include <posidonia/apps/progress.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/trajectory_io.h>
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
	m_folder = std::make_unique<CRunFolder>(line.outputDir(), m_input.name());
	return true;
}

namespace
{
/** Keeps MRPT's timer from printing its table when it dies, in an error too: the times are in timings.csv. */
struct TSilencedAtEnd
{
	mrpt::system::CTimeLogger& timer;
	~TSilencedAtEnd() { timer.disable(); }
};
}  // namespace

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
	replay(slam, reader);
	slam.makeExact();
	collect(slam, reader);
	writeResults(slam);
	logSummary(slam, reader, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
	if (!m_input.truth.empty()) score(slam);
	writeMetricsJson(m_folder->file("metrics.json"), m_results.metrics);
	m_folder->log("run folder: " + m_folder->path(), m_input.verbosity);
	m_folder->finish();
}

void CGraphSlamApp::replay(CStereoSlam& slam, CRawlogReader& reader)
{
	CProgress progress("graph-SLAM", m_input.verbosity == 0);
	while (const auto observation = reader.next()) {
		slam.add(observation);
		if (!IS_CLASS(*observation, CObservationStereoImages) || slam.map().nodeCount() == 0) continue;
		remember(slam);
		progress.update(
			reader.progress(),
			mrpt::format("%d nodes, %zu edges", slam.map().nodeCount(), slam.map().edges().size()));
	}
	progress.update(1);
}

void CGraphSlamApp::remember(const CStereoSlam& slam)
{
	auto& t = m_results.trajectories;
	const TCausalPose pose = slam.causal().back();
	t.ekf.push_back({pose.stamp, uncorruptedPose(slam.odometry())});
	t.odom.push_back({pose.stamp, pose.T_odom_body});
	t.slam.push_back({pose.stamp, pose.T_map_body});
}

void CGraphSlamApp::collect(const CStereoSlam& slam, const CRawlogReader& reader)
{
	if (slam.map().nodeCount() == 0)
		throw CError(
			reader.path(),
			"no node was made: " +
				std::string(
					slam.odometry().ready() ? "it holds no stereo pair" : "the odometry never became ready"),
			"check its sensors with rawlog-edit --info, and [InitialPose]");
	m_results.trajectories.nodes = slam.nodes();
	m_results.nodes = slam.map().nodeCount();
	for (const auto& edge : slam.map().edges()) {
		m_results.sequential_edges += edge.kind == EEdgeKind::SEQUENTIAL;
		m_results.roi_edges += edge.kind == EEdgeKind::ROI;
	}
	m_results.chi2 = slam.chi2();
	m_results.dijkstra_chi2 = slam.dijkstraChi2();
	m_results.metrics = {
		{"graph.nodes", "", static_cast<double>(m_results.nodes)},
		{"graph.sequential_edges", "", static_cast<double>(m_results.sequential_edges)},
		{"graph.roi_edges", "", static_cast<double>(m_results.roi_edges)},
		{"graph.chi2", "", m_results.chi2},
		{"graph.chi2_dijkstra", "", m_results.dijkstra_chi2}};
}

void CGraphSlamApp::writeResults(const CStereoSlam& slam)
{
	const auto& t = m_results.trajectories;
	writeTum(m_folder->file("ekf.tum"), t.ekf);
	writeTum(m_folder->file("odom.tum"), t.odom);
	writeTum(m_folder->file("slam.tum"), t.slam);
	writeTum(m_folder->file("nodes.tum"), t.nodes);
	slam.saveG2o(m_folder->file("graph.g2o"));
	m_folder->write("loops.csv", candidatesCsv(slam.map().candidates));
	m_folder->write("timings.csv", timingsCsv(slam.timer(), m_results.nodes));
}

void CGraphSlamApp::score(const CStereoSlam&)
{
	const TScore score = scoreRun(
		scoringOf(params, m_input.sensors), m_results.trajectories, m_folder->file("loops.csv"),
		m_input.truth, *m_folder);
	m_results.metrics.insert(m_results.metrics.end(), score.metrics.begin(), score.metrics.end());
	if (!score.text.empty()) m_folder->log(score.text, m_input.verbosity);
	m_folder->log(scoreSummary(score.metrics), m_input.verbosity);
	m_folder->log("truth: " + m_input.truth, m_input.verbosity - 1);
}

void CGraphSlamApp::logSummary(const CStereoSlam& slam, const CRawlogReader& reader, double seconds)
{
	m_folder->log(versionText(), m_input.verbosity - 1);
	const std::string losses = replayLosses(reader);
	if (!losses.empty()) m_folder->log(losses, m_input.verbosity + 1);	// even when quiet
	m_folder->log(
		mrpt::format(
			"%d nodes, %d sequential and %d ROI edges; chi2 %.1f (composed from the root: %.3g)",
			m_results.nodes, m_results.sequential_edges, m_results.roi_edges, m_results.chi2,
			m_results.dijkstra_chi2),
		m_input.verbosity);
	m_folder->log(candidateCounts(slam.map().candidates), m_input.verbosity);
	const auto& poses = m_results.trajectories.slam;
	m_folder->log(speedText(poses.back().stamp - poses.front().stamp, seconds), m_input.verbosity);
	m_folder->log(navigationText(slam.odometry()), m_input.verbosity - 1);
}
}  // namespace posidonia
