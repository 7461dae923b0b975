#include <posidonia/base/error.h>
#include <posidonia/eval/number_text.h>
#include <posidonia/eval/text_table.h>
#include <posidonia/report/paper_table.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace posidonia
{
namespace
{
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct TPaperTable
{
	std::string title;
	std::vector<TPaperRow> rows;
};

TPaperTable published(int experiment)
{
	if (experiment == 1)
		return {
			"Table 2 of the paper (experiment 1), and ours",
			{{"Odometry", 181.06, 0.64}, {"SLAM", 181.14, 0.15}, {"Ground truth", 181.13, kNone}}};
	if (experiment == 2)
		return {
			"Table 3 of the paper (experiment 2), and ours",
			{{"Odometry", 181.76, 1.95}, {"SLAM", 182.71, 0.40}, {"Ground truth", 182.65, kNone}}};
	throw CError("paper table", "no experiment " + std::to_string(experiment), "the paper has 1 and 2");
}

/** Ours with a digit more: centimetres would hide it. */
void addRows(
	TTextRows& table, const std::string& whose, const std::vector<TPaperRow>& rows, int decimals, bool steers)
{
	const auto text = [&](double value) {
		return std::isfinite(value) ? fixedText(value, decimals) : std::string("-");
	};
	for (const auto& row : rows) {
		std::vector<std::string> cells{whose + row.input, fixedText(row.length, 2), text(row.mean_error)};
		if (steers) cells.insert(cells.end(), {text(row.end_error), text(row.cross_track)});
		table.rows.push_back(cells);
	}
}
}  // namespace

std::vector<TPaperRow> paperRows(const TMetrics& metrics)
{
	const auto row = [&](const char* input, const std::string& name) {
		return TPaperRow{
			input, metric(metrics, name + ".length"), metric(metrics, name + ".ate.unaligned.mean")};
	};
	const auto has = [&](const std::string& what) {
		return std::any_of(metrics.begin(), metrics.end(), [&](const TMetric& m) { return m.what == what; });
	};
	std::vector<TPaperRow> rows{
		{"Ground truth", metric(metrics, "nodes.truth_length"), kNone},
		row("Odometry", "odom"),
		row("Posidonia (nodes)", "nodes"),
		row("Posidonia (causal)", "slam")};
	if (!has("control.length")) return rows;
	rows.push_back(row("Posidonia (in control)", "control"));
	if (has("mission.end_error.mean")) {
		rows.back().end_error = metric(metrics, "mission.end_error.mean");
		rows.back().cross_track = metric(metrics, "mission.cross_track.mean");
	}
	return rows;
}

TTextRows paperTableRows(int experiment, const std::vector<TPaperRow>& ours)
{
	const TPaperTable paper = published(experiment);
	const bool steers = std::any_of(ours.begin(), ours.end(), [](const TPaperRow& r) {
		return std::isfinite(r.end_error) || std::isfinite(r.cross_track);
	});
	TTextRows table{paper.title, {"Input", "Traj. Dist. (m)", "Trans. ME (m)"}, {}};
	if (steers) table.header.insert(table.header.end(), {"End (m)", "Cross-track (m)"});
	addRows(table, "paper: ", paper.rows, 2, steers);
	addRows(table, "ours:  ", ours, 3, steers);
	return table;
}

std::string paperTable(int experiment, const std::vector<TPaperRow>& ours)
{
	const TTextRows cells = paperTableRows(experiment, ours);
	CTextTable table(cells.header);
	for (const auto& row : cells.rows)
		table.add(row);
	return cells.title + '\n' + table.text();
}
}  // namespace posidonia
