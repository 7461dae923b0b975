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
	CTextTable& table, const std::string& whose, const std::vector<TPaperRow>& rows, int decimals,
	bool steers)
{
	const auto text = [&](double value) {
		return std::isfinite(value) ? fixedText(value, decimals) : std::string("-");
	};
	for (const auto& row : rows) {
		std::vector<std::string> cells{whose + row.input, fixedText(row.length, 2), text(row.mean_error)};
		if (steers) cells.insert(cells.end(), {text(row.end_error), text(row.cross_track)});
		table.add(cells);
	}
}
}  // namespace

std::string paperTable(int experiment, const std::vector<TPaperRow>& ours)
{
	const TPaperTable paper = published(experiment);
	const bool steers = std::any_of(ours.begin(), ours.end(), [](const TPaperRow& r) {
		return std::isfinite(r.end_error) || std::isfinite(r.cross_track);
	});
	std::vector<std::string> header{"Input", "Traj. Dist. (m)", "Trans. ME (m)"};
	if (steers) header.insert(header.end(), {"End (m)", "Cross-track (m)"});
	CTextTable table(header);
	addRows(table, "paper: ", paper.rows, 2, steers);
	addRows(table, "ours:  ", ours, 3, steers);
	return paper.title + '\n' + table.text();
}
}  // namespace posidonia
