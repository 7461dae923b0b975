#include <mrpt/obs/CObservationRobotPose.h>
#include <posidonia/apps/CEkfApp.h>
#include <posidonia/apps/progress.h>
#include <posidonia/apps/run_texts.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/trajectory_io.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/nav/rts_smoother.h>
#include <posidonia/obs/observations.h>

#include <chrono>
#include <filesystem>
#include <iostream>

namespace fs = std::filesystem;

namespace posidonia
{
using mrpt::obs::CObservationRobotPose;
using mrpt::obs::CObservationStereoImages;

bool CEkfApp::initialize(int argc, const char* const* argv)
{
	CCommandLine line(
		name,
		"The navigation filter alone over a rawlog: writes a run folder with its trajectory (ekf.tum) and "
		"NAME-ekf.rawlog,\n"
		"all observations as read plus the filter's poses (CObservationRobotPose, label EKF). The drift of\n"
		"[OdometryCorruption] is left out.\n"
		"Example: auv-ekf -c ini/paper-exp2.ini -r data/paper-exp2.rawlog");
	CReplayCommand replay(line);
	TCLAP::ValueArg<double> rate(
		"", "rate", "At most so many poses a second (default: 10)", false, 10, "HZ", line.cmd());
	TCLAP::SwitchArg smooth(
		"", "smooth",
		"Also write smoothed.tum: poses that know what came after them (Rauch-Tung-Striebel), for use "
		"after the mission",
		line.cmd());
	TCLAP::SwitchArg json("", "json", "Print the metrics as JSON instead of the summary", line.cmd());
	if (!line.parse(argc, argv)) return false;

	if (!(rate.getValue() > 0)) throw CUsageError("--rate", "must be > 0", "give poses a second");
	if (!replay.load(line.ini(), m_input, params)) return false;
	m_rate = rate.getValue();
	m_smooth = smooth.getValue();
	if (m_smooth && (params.odometry.source != "ekf" || params.ekf.mode == "cola2"))
		throw CUsageError(
			"--smooth", "needs our own navigation filter",
			"set [Odometry] source = ekf and [Ekf] mode = ins, gyro or kinematic");
	m_json = json.getValue();
	if (m_json) m_input.verbosity = 0;
	m_folder = std::make_unique<CRunFolder>(line.outputDir(), m_input.name() + "-ekf");
	return true;
}

void CEkfApp::run()
{
	const auto start = std::chrono::steady_clock::now();  // for the log alone
	m_results = {};
	m_has_pictures = false;
	m_results.folder = m_folder->path();
	m_results.rawlog = m_folder->file(m_input.name() + "-ekf.rawlog");
	CRawlogReader reader(m_input.rawlog);
	const auto odometry = params.makeCleanOdometry(m_input.sensors);
	auto* ekf = dynamic_cast<CEkfOdometry*>(odometry.get());
	if (ekf) ekf->withoutEdges();  // nobody makes nodes here
	m_readings.clear();
	if (m_smooth) ekf->keepReadings(m_readings);
	CRawlogWriter writer(m_results.rawlog);
	const CInterrupt interrupt;	 // to the end: what was run is written whole
	replay(*odometry, reader, writer, interrupt);
	if (m_results.ekf.empty())
		throw CError(
			m_input.rawlog, "the odometry never became ready",
			"check its sensors with rawlog-edit --info, and [InitialPose] and [Odometry]");
	writer.finish();
	m_folder->write("config.ini", m_input.config);
	writeSensors(m_folder->file("sensors.ini"), m_input.sensors);
	writeSensors(sensorsPathOf(m_results.rawlog), m_input.log_sensors);
	writeTum(m_folder->file("ekf.tum"), m_results.ekf);
	m_results.last = odometry->now();
	summarize(m_results.last);
	logSummary(
		*odometry, reader, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
	if (m_smooth) smooth(*ekf);
	if (m_has_pictures) linkImages();
	if (!m_input.truth.empty()) score();
	writeMetricsJson(m_folder->file("metrics.json"), m_results.metrics);
	if (m_json) std::cout << metricsJson(m_results.metrics);
	m_folder->log("rawlog with poses: " + m_results.rawlog, m_input.verbosity);
	m_folder->log("run folder: " + m_folder->path(), m_input.verbosity);
	writeReportFiles(*odometry);
	finishReport(*m_folder, params.report, m_input.verbosity);
}

void CEkfApp::writeReportFiles(const COdometrySource& odometry)
{
	const double start = m_results.ekf.front().stamp, end = m_results.ekf.back().stamp;
	writeSensorCounts(*m_folder, odometry, end - start);
	writeRunInfo(
		*m_folder, {name, m_input.name(), versionText(), copyTruth(*m_folder, m_input.truth, start, end),
					m_results.interrupted, start, end - start, params.simulation.world});
}

void CEkfApp::replay(
	COdometrySource& odometry, CRawlogReader& reader, CRawlogWriter& writer, const CInterrupt& interrupt)
{
	CProgress progress("navigation filter", m_input.verbosity == 0);
	while (const auto observation = reader.next()) {
		m_results.interrupted = interrupt.requested();
		if (m_results.interrupted) return;
		if (IS_CLASS(*observation, CObservationRobotPose) && observation->sensorLabel == pose_label)
			throw CError(
				m_input.rawlog, std::string("holds poses labelled ") + pose_label + " already",
				"remove them with rawlog-edit --remove-label " + std::string(pose_label));
		const auto* pair = dynamic_cast<const CObservationStereoImages*>(observation.get());
		m_has_pictures = m_has_pictures || (pair && pair->imageLeft.isExternallyStored());
		writer.write(*observation);
		odometry.add(*observation);
		if (isDue(odometry)) writePose(odometry, writer);
		constexpr size_t kSeldom = 256;	 // asking where the file is costs as much as a filter's step
		if (m_results.observations++ % kSeldom == 0) progress.update(reader.progress());
	}
	progress.update(1);
}

bool CEkfApp::isDue(const COdometrySource& odometry) const
{
	if (!odometry.ready()) return false;
	constexpr double kSlack = 0.999;  // sensors' stamps are not exact multiples of their periods
	return m_results.ekf.empty() || odometry.stamp() >= m_results.ekf.back().stamp + kSlack / m_rate;
}

void CEkfApp::writePose(const COdometrySource& odometry, CRawlogWriter& writer)
{
	const TPoseEstimate now = odometry.now();
	CObservationRobotPose pose;
	pose.sensorLabel = pose_label;
	pose.timestamp = stampFrom(odometry.stamp());
	pose.pose = toMrptGaussian(now.T, now.cov);
	writer.write(pose);
	m_results.ekf.push_back({odometry.stamp(), now.T});
}

void CEkfApp::smooth(const CEkfOdometry& odometry)
{
	m_folder->log("smoothing " + std::to_string(m_readings.size()) + " readings", m_input.verbosity);
	CRtsSmoother smoother(odometry.sharedSetup());
	for (const TStampedEstimate& e : smoother.smooth(std::move(m_readings), 1 / m_rate))
		m_results.smoothed.push_back({e.stamp, e.pose.T});
	writeTum(m_folder->file("smoothed.tum"), m_results.smoothed);
}

void CEkfApp::linkImages()
{
	const fs::path images = imagesFolderOf(m_input.rawlog), link = imagesFolderOf(m_results.rawlog);
	if (!fs::is_directory(images)) {
		m_folder->log(
			"warning: " + images.string() + "/ is not there; put it beside the new rawlog",
			m_input.verbosity + 1);
		return;
	}
	std::error_code problem;
	if (fs::is_symlink(link)) fs::remove(link, problem);
	const fs::path target = fs::relative(images, link.parent_path(), problem);
	if (!problem) fs::create_directory_symlink(target, link, problem);
	if (problem)
		throw CError(link.string(), "can't link the pictures: " + problem.message(), "choose another -o");
	m_folder->log(
		"pictures: " + link.filename().string() + " -> " + target.string() + " (not copied)",
		m_input.verbosity);
}

void CEkfApp::summarize(const TPoseEstimate& last)
{
	const auto pdf = toMrptGaussian(last.T, last.cov);
	const auto sigma = [&](int i) { return std::sqrt(pdf.cov(i, i)); };
	constexpr double kDegrees = 180 / M_PI;
	m_results.metrics = {
		{"navigation.duration", "s", m_results.ekf.back().stamp - m_results.ekf.front().stamp},
		{"navigation.way", "m", last.path_length},
		{"navigation.sigma_north", "m", sigma(0)},
		{"navigation.sigma_east", "m", sigma(1)},
		{"navigation.sigma_down", "m", sigma(2)},
		{"navigation.sigma_yaw", "deg", kDegrees * sigma(3)},
		{"navigation.sigma_pitch", "deg", kDegrees * sigma(4)},
		{"navigation.sigma_roll", "deg", kDegrees * sigma(5)}};
}

void CEkfApp::score()
{
	const TTrajectory truth = readTrajectory(m_input.truth);
	const auto add = [&](const std::string& what, const TTrajectory& estimate) {
		const auto evaluation = evaluateRun(what, estimate, truth, params.evaluation);
		TMetrics& metrics = m_results.metrics;
		metrics.insert(metrics.end(), evaluation.metrics.begin(), evaluation.metrics.end());
		const auto value = [&](const char* name) { return metric(metrics, what + name); };
		m_folder->log(
			mrpt::format(
				"%s, 3D error: mean %.4f m, worst %.4f m, at the end %.4f m unaligned; mean %.4f m "
				"yaw+position-aligned",
				what.c_str(), value(".ate.unaligned.mean"), value(".ate.unaligned.max"),
				value(".end_error.unaligned"), value(".ate.yaw_position.mean")),
			m_input.verbosity);
	};
	add("ekf", m_results.ekf);
	if (!m_results.smoothed.empty()) add("smoothed", m_results.smoothed);
	m_folder->log("truth: " + m_input.truth, m_input.verbosity - 1);
}

void CEkfApp::logSummary(const COdometrySource& odometry, const CRawlogReader& reader, double seconds)
{
	m_folder->log(versionText(), m_input.verbosity - 1);
	if (m_results.interrupted) m_folder->log(interruptedText(), m_input.verbosity + 1);
	const std::string losses = replayLosses(reader);
	if (!losses.empty()) m_folder->log(losses, m_input.verbosity + 1);	// even when quiet
	const auto value = [&](const char* what) { return metric(m_results.metrics, what); };
	m_folder->log(
		mrpt::format(
			"%zu observations, %.1f m, %zu poses; %s", m_results.observations, value("navigation.way"),
			m_results.ekf.size(), speedText(value("navigation.duration"), seconds).c_str()),
		m_input.verbosity);
	const std::string statistics = navigationText(odometry);
	if (!statistics.empty()) m_folder->log(statistics.substr(0, statistics.size() - 1), m_input.verbosity);
	m_folder->log(
		mrpt::format(
			"final sigmas: north %.3f m, east %.3f m, down %.3f m; yaw %.3f deg, pitch %.3f deg, roll %.3f "
			"deg",
			value("navigation.sigma_north"), value("navigation.sigma_east"), value("navigation.sigma_down"),
			value("navigation.sigma_yaw"), value("navigation.sigma_pitch"), value("navigation.sigma_roll")),
		m_input.verbosity);
}
}  // namespace posidonia
