#include <posidonia/base/error.h>
#include <posidonia/eval/number_text.h>
#include <posidonia/eval/text_table.h>
#include <posidonia/report/paper_table.h>

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
void addRows(CTextTable& table, const std::string& whose, const std::vector<TPaperRow>& rows, int decimals)
{
	for (const auto& row : rows)
		table.add(
			{whose + row.input, fixedText(row.length, 2),
			 std::isfinite(row.mean_error) ? fixedText(row.mean_error, decimals) : "-"});
}
}  // namespace

std::string paperTable(int experiment, const std::vector<TPaperRow>& ours)
{
	const TPaperTable paper = published(experiment);
	CTextTable table({"Input", "Traj. Dist. (m)", "Trans. ME (m)"});
	addRows(table, "paper: ", paper.rows, 2);
	addRows(table, "ours:  ", ours, 3);
	return paper.title + '\n' + table.text();
}
}  // namespace posidonia
