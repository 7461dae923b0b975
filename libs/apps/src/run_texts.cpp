#include <posidonia/apps/run_texts.h>
#include <posidonia/base/files.h>

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace posidonia
{
std::string timingsCsv(mrpt::system::CTimeLogger& timer, int nodes)
{
	std::map<std::string, mrpt::system::CTimeLogger::TCallStats> stats;
	timer.getStats(stats);
	std::string csv = "stage,calls,mean_ms,max_ms,total_s,ms_per_node\n";
	for (const auto& [stage, s] : stats)
		csv += mrpt::format(
			"%s,%zu,%.4f,%.3f,%.3f,%.3f\n", stage.c_str(), s.n_calls, 1e3 * s.mean_t, 1e3 * s.max_t,
			s.total_t, nodes ? 1e3 * s.total_t / nodes : 0.0);
	return csv;
}

std::string stagesText(const std::vector<mrpt::system::CTimeLogger*>& timers)
{
	std::vector<std::pair<double, std::string>> stages;
	for (auto* timer : timers) {
		std::map<std::string, mrpt::system::CTimeLogger::TCallStats> stats;
		timer->getStats(stats);
		for (const auto& [stage, s] : stats)
			stages.emplace_back(s.total_t, stage);
	}
	std::sort(stages.rbegin(), stages.rend());
	std::string text;
	for (const auto& [seconds, stage] : stages)
		text += mrpt::format("%s%s %.1f s", text.empty() ? "" : ", ", stage.c_str(), seconds);
	return text;
}

std::string candidateCounts(const std::vector<TCandidateRow>& rows)
{
	std::map<std::string, std::map<std::string, int>> counts;
	std::map<std::string, int> totals;
	for (const auto& row : rows) {
		counts[toString(row.kind)][row.status]++;
		totals[toString(row.kind)]++;
	}
	std::string text;
	for (const auto& [kind, by_status] : counts) {
		text += (text.empty() ? "" : "\n") + std::to_string(totals[kind]) + " " + kind + " candidates:";
		const char* separator = " ";
		for (const auto& [status, n] : by_status) {
			text += separator + std::to_string(n) + " " + status;
			separator = ", ";
		}
	}
	return text.empty() ? "no stereo candidates" : text;
}

std::string scoreSummary(const TMetrics& metrics)
{
	std::string text;
	for (const char* what : {"nodes", "slam", "odom"}) {
		const std::string p = std::string(what) + ".ate.";
		text += mrpt::format(
			"%-5s mean 3D error %.4f m unaligned, %.4f m yaw+position-aligned, worst %.4f m\n", what,
			metric(metrics, p + "unaligned.mean"), metric(metrics, p + "yaw_position.mean"),
			metric(metrics, p + "unaligned.max"));
	}
	text += mrpt::format(
		"loops: %.0f accepted, %.0f false; sequential: %.0f accepted, %.0f false",
		metric(metrics, "loops.accepted"), metric(metrics, "loops.false"),
		metric(metrics, "loops.sequential.accepted"), metric(metrics, "loops.sequential.false"));
	return text;
}

std::string replayLosses(const CRawlogReader& reader)
{
	std::string text;
	if (!reader.damage().empty()) text = "warning: " + reader.damage();
	if (reader.actionsLeftAside() > 0)
		text += (text.empty() ? "" : "\n") +
				mrpt::format("%zu robot actions left aside", reader.actionsLeftAside());
	return text;
}

std::string speedText(double log_seconds, double seconds)
{
	rusage usage{};
	getrusage(RUSAGE_SELF, &usage);
	return mrpt::format(
		"%.1f s of log in %.1f s (%.0f x real time), peak memory %.0f MB", log_seconds, seconds,
		log_seconds / seconds, static_cast<double>(usage.ru_maxrss) / 1024);
}

std::string interruptedText()
{
	return "INTERRUPTED: what follows is of the part that was run; the run folder is whole";
}

std::string truthFor(const std::string& rawlog, const std::string& given)
{
	if (!given.empty()) {
		requireFile(given, "give an existing TUM file with -g/--ground-truth");
		return given;
	}
	const std::string beside = rawlog.substr(0, rawlog.rfind(".rawlog")) + ".gt.tum";
	return std::filesystem::exists(beside) ? beside : std::string();
}
}  // namespace posidonia
