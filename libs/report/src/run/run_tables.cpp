#include <posidonia/base/error.h>
#include <posidonia/report/run_files.h>

#include <charconv>
#include <limits>

#include "csv_lines.h"

namespace posidonia
{
namespace
{
const std::string kSensorsHeader = "sensor,used,rate_hz,longest_gap_s,rejected",
				  kTimingsHeader = "stage,calls,mean_ms,max_ms,total_s,ms_per_node",
				  kEventsHeader = "t,kind,text";
}

std::string sensorsCsv(const std::vector<TSensorRow>& rows)
{
	std::string csv = kSensorsHeader + "\n";
	for (const TSensorRow& row : rows) {
		csv += row.name + "," + std::to_string(row.used) + numberText(row.rate, ",%.4g") +
			   numberText(row.longest_gap, ",%.4g,");
		const char* separator = "";
		for (const auto& [reason, count] : row.rejected) {
			csv += separator + reason + "=" + std::to_string(count);
			separator = ";";
		}
		csv += "\n";
	}
	return csv;
}

std::vector<TSensorRow> readSensorRows(const std::string& path)
{
	std::vector<TSensorRow> rows;
	for (const TDataLine& line : linesUnder(kSensorsHeader, path)) {
		const auto cells = cellsOf(line, 5);
		TSensorRow row{
			cells[0],
			static_cast<size_t>(line.whole(cells[1])),
			line.real(cells[2]),
			line.real(cells[3]),
			{}};
		for (size_t start = 0; start < cells[4].size();) {
			const size_t end = std::min(cells[4].find(';', start), cells[4].size());
			const std::string pair = cells[4].substr(start, end - start);
			const size_t equals = pair.find('=');
			if (equals == std::string::npos) line.fail("'" + pair + "' is not reason=count", kWriteAgain);
			row.rejected[pair.substr(0, equals)] = static_cast<size_t>(line.whole(pair.substr(equals + 1)));
			start = end + 1;
		}
		rows.push_back(row);
	}
	return rows;
}

std::vector<TTimingRow> readTimings(const std::string& path)
{
	std::vector<TTimingRow> rows;
	for (const TDataLine& line : linesUnder(kTimingsHeader, path)) {
		const auto cells = cellsOf(line, 6);
		rows.push_back(
			{cells[0], static_cast<size_t>(line.whole(cells[1])), line.real(cells[2]), line.real(cells[3]),
			 line.real(cells[4])});
	}
	return rows;
}

std::vector<TEventRow> readEvents(const std::string& path)
{
	std::vector<TEventRow> rows;
	for (const TDataLine& line : linesUnder(kEventsHeader, path)) {
		const size_t first = line.text.find(','), second = line.text.find(',', first + 1);
		if (second == std::string::npos || line.text.size() < second + 3)
			line.fail("is not t,kind,\"text\"", kWriteAgain);
		rows.push_back(
			{line.real(line.text.substr(0, first)), line.text.substr(first + 1, second - first - 1),
			 line.text.substr(second + 2, line.text.size() - second - 3)});
	}
	return rows;
}

const std::vector<double>& TNumberTable::column(const std::string& name) const
{
	const auto found = columns.find(name);
	if (found == columns.end()) throw CError("column " + name, "is not there", kWriteAgain);
	return found->second;
}

TNumberTable readNumberTable(const std::string& path)
{
	const std::vector<TDataLine> lines = readDataLines(path);
	if (lines.empty()) throw CError(path, "is empty", kWriteAgain);
	const auto names = lines[0].cellsByComma();
	std::vector<std::vector<double>> values(names.size());
	for (size_t k = 1; k < lines.size(); k++) {
		const auto cells = cellsOf(lines[k], names.size());
		for (size_t c = 0; c < cells.size(); c++) {
			double value = std::numeric_limits<double>::quiet_NaN();
			std::from_chars(cells[c].data(), cells[c].data() + cells[c].size(), value);
			values[c].push_back(value);
		}
	}
	TNumberTable table;
	for (size_t c = 0; c < names.size(); c++)
		table.columns[names[c]] = std::move(values[c]);
	return table;
}
}  // namespace posidonia
