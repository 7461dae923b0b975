#include <posidonia/apps/run_summary.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/number_text.h>
#include <posidonia/eval/statistics.h>
#include <posidonia/eval/text_table.h>

#include <cmath>
#include <filesystem>
#include <optional>

namespace posidonia
{
namespace
{
struct TJudgedBy
{
	const char* what;
	bool large_is_bad;
	bool of_missions{false};  ///< Rows that only closed loops have
};
constexpr TJudgedBy kJudgedBy[] = {
	{"nodes.ate.unaligned.mean", true},
	{"slam.ate.unaligned.mean", true},
	{"odom.ate.unaligned.mean", true},
	{"nodes.ate.yaw_position.mean", true},
	{"loops.accepted", false},
	{"loops.false", true},
	{"loops.sequential.false", true},
	{"loops.recall_of_tried", false},
	{"loops.recall_of_all", false},
	{"control.ate.unaligned.mean", true, true},
	{"control.ate.unaligned.max", true, true},
	{"mission.cross_track.mean", true, true},
	{"mission.end_error.mean", true, true},
	{"mission.end_error.max", true, true},
	{"mission.depth_error.mean", true, true},
	{"mission.path_length", true, true},
	{"mission.duration", true, true},
	{"mission.leg_speed", false, true},
	{"mission.leg_altitude", false, true},
	{"mission.yaw_rate_step.p99", true, true},
	{"mission.yaw_rate_step.max", true, true},
	{"mission.surge_step.p99", true, true},
	{"mission.surge_step.max", true, true},
	{"mission.yaw_rate_range.p99", true, true},
	{"mission.yaw_rate_range.max", true, true},
	{"mission.surge_range.p99", true, true},
	{"mission.surge_range.max", true, true}};

/** The finite row, if the run has it. */
std::optional<TMetric> find(const TMetrics& rows, const std::string& what)
{
	for (const auto& row : rows)
		if (row.what == what && std::isfinite(row.value)) return row;
	return {};
}

std::string joined(const std::vector<std::string>& names)
{
	std::string text;
	for (const auto& name : names)
		text += (text.empty() ? "" : ", ") + name;
	return text;
}
}  // namespace

TSummary summarize(const std::vector<TRunMetrics>& runs)
{
	TSummary summary;
	for (const auto& [what, large_is_bad, of_missions] : kJudgedBy) {
		std::vector<double> values;
		std::vector<std::string> without;
		std::string unit;
		for (const auto& [name, metrics] : runs) {
			const auto row = find(metrics, what);
			if (!row) {
				without.push_back(name);
				continue;
			}
			values.push_back(row->value);
			unit = row->unit;
		}
		if (of_missions && values.empty()) continue;
		if (!without.empty()) {
			summary.notes.push_back(std::string(what) + " is left out: no value in " + joined(without));
			continue;
		}
		const TStatistics s = statistics(values);
		summary.rows.push_back({what, unit, s.median, large_is_bad ? s.max : s.min});
	}
	if (summary.rows.empty())
		throw CError(
			"--summary", "no metric has a value in every run",
			"score the runs first: give auv-graphslam the truth with -g");
	return summary;
}

std::string TSummary::text() const
{
	CTextTable table({"what", "median", "worst", "unit"});
	for (const auto& row : rows)
		table.add({row.what, significantText(row.median, 6), significantText(row.worst, 6), row.unit});
	std::string text = table.text();
	for (const auto& note : notes)
		text += "note: " + note + "\n";
	return text;
}

TMetrics TSummary::metrics() const
{
	TMetrics all;
	for (const auto& row : rows) {
		all.push_back({row.what + ".median", row.unit, row.median});
		all.push_back({row.what + ".worst", row.unit, row.worst});
	}
	return all;
}

TRunMetrics readRunMetrics(const std::string& folder_or_file)
{
	const bool folder = std::filesystem::is_directory(folder_or_file);
	const std::string file = folder ? folder_or_file + "/metrics.json" : folder_or_file;
	requireFile(file, "give folders of runs that have one");
	return {folder_or_file, readMetricsJson(file)};
}
}  // namespace posidonia
