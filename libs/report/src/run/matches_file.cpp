#include <posidonia/report/run_files.h>

#include "csv_lines.h"

namespace posidonia
{
namespace
{
const std::string kMatchesHeader = "from,to,chi2,points";
}

std::string matchesCsv(const std::vector<TMatchesRow>& rows)
{
	std::string csv = kMatchesHeader + "\n";
	for (const TMatchesRow& row : rows) {
		csv += std::to_string(row.from) + "," + std::to_string(row.to) + numberText(row.chi2, ",%.6g,");
		const char* separator = "";
		for (const auto& [a, b] : row.points) {
			csv += separator + numberText(a.x(), "%.0f") + numberText(a.y(), " %.0f") +
				   numberText(b.x(), " %.0f") + numberText(b.y(), " %.0f");
			separator = " ";
		}
		csv += "\n";
	}
	return csv;
}

std::vector<TMatchesRow> readMatches(const std::string& path)
{
	std::vector<TMatchesRow> rows;
	for (const TDataLine& line : linesUnder(kMatchesHeader, path)) {
		const auto cells = cellsOf(line, 4);
		TMatchesRow row;
		row.from = static_cast<int>(line.whole(cells[0]));
		row.to = static_cast<int>(line.whole(cells[1]));
		row.chi2 = line.real(cells[2]);
		const auto numbers = TDataLine{line.path, line.number, cells[3]}.cellsByBlank();
		if (numbers.size() % 4 != 0) line.fail("points are not four numbers each", kWriteAgain);
		for (size_t k = 0; k < numbers.size(); k += 4)
			row.points.push_back(
				{{line.real(numbers[k]), line.real(numbers[k + 1])},
				 {line.real(numbers[k + 2]), line.real(numbers[k + 3])}});
		rows.push_back(row);
	}
	return rows;
}
}  // namespace posidonia
