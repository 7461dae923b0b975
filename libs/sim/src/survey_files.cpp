#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/obs/rawlog_writer.h>
#include <posidonia/obs/register_observations.h>
#include <posidonia/sim/pair_files.h>
#include <posidonia/sim/survey_simulator.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <thread>

namespace posidonia
{
using mrpt::obs::CObservationStereoImages;

namespace
{
/** job(0) ... job(n - 1) on `threads` threads; the first exception is thrown again here. */
void inParallel(size_t n, int threads, const std::function<void(size_t)>& job)
{
	std::atomic<size_t> next{0};
	std::mutex mutex;
	std::exception_ptr problem;
	const auto work = [&] {
		for (size_t i = next++; i < n; i = next++)
			try {
				job(i);
			}
			catch (...) {
				const std::lock_guard lock(mutex);
				if (!problem) problem = std::current_exception();
				next = n;
			}
	};
	std::vector<std::thread> pool;
	for (int i = 1; i < threads; i++)
		pool.emplace_back(work);
	work();
	for (auto& thread : pool)
		thread.join();
	if (problem) std::rethrow_exception(problem);
}
}  // namespace

TSimulationSummary CSurveySimulator::run(const std::string& prefix, const progress_t& progress)
{
	registerObservations();
	const std::string rawlog = prefix + ".rawlog", images = imagesFolderOf(rawlog);
	if (m_scene.hasCamera()) {
		std::filesystem::remove_all(images);  // no picture of an earlier run stays behind
		makeFolder(images);
	}
	TSimulationSummary summary;
	summary.duration = duration();
	TTrajectory truth;
	std::vector<TSimulatedObservation> pairs;
	CRawlogWriter writer(rawlog);
	stream([&](const TSimulatedObservation& o) {
		if (o.frame) {
			if (!truth.empty())
				summary.path_length +=
					(o.truth.T_map_body.translation() - truth.back().T.translation()).norm();
			truth.push_back({stampOf(*o.observation), o.truth.T_map_body});
			if (o.kept) pairs.push_back(o);
		}
		if (o.kept) writer.write(*o.observation);
	});

	std::mutex mutex;
	size_t done = 0;
	inParallel(pairs.size(), m_options.run.threads, [&](size_t i) {
		const auto& observation = dynamic_cast<const CObservationStereoImages&>(*pairs[i].observation);
		uint64_t bytes = writePictures(render(pairs[i]), observation, images);
		if (m_options.run.save_depth) bytes += writeDepths(depths(pairs[i]), observation, images);
		const std::lock_guard lock(mutex);
		summary.image_bytes += bytes;
		if (progress) progress(static_cast<double>(++done) / static_cast<double>(pairs.size()));
	});
	summary.observations = writer.count();
	summary.stereo_pairs = truth.size();
	summary.kept_pairs = pairs.size();
	if (m_scene.hasCamera() && m_options.run.overview) writeOverview(prefix + ".overview.png", truth);
	if (m_scene.hasCamera()) writeTumTrajectory(prefix + ".gt.tum", truth);
	writeSensors(sensorsPathOf(rawlog), m_nominal);
	writer.finish();
	return summary;
}

void CSurveySimulator::writeOverview(const std::string& path, const TTrajectory& truth) const
{
	std::vector<Eigen::Vector3d> way;
	for (const auto& pose : truth)
		way.push_back(pose.T.translation());
	m_scene.writeOverview(path, way);
}

void writeTumTrajectory(const std::string& path, const TTrajectory& trajectory)
{
	writeFileWhole(path, [&](std::ostream& out) {
		char line[256];
		for (const auto& pose : trajectory) {
			const Eigen::Vector3d t = pose.T.translation();
			const Eigen::Quaterniond q(pose.T.linear());
			std::snprintf(
				line, sizeof line, "%.9f %.12f %.12f %.12f %.12f %.12f %.12f %.12f\n", pose.stamp, t.x(),
				t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
			out << line;
		}
	});
}
}  // namespace posidonia
