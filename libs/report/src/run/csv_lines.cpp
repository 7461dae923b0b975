#include <posidonia/base/error.h>

#include "csv_lines.h"

namespace posidonia
{
std::string numberText(double value, const char* format)
{
	char text[64];
	std::snprintf(text, sizeof text, format, value);
	return text;
}

/** The lines below a header that must be `header`. */
std::vector<TDataLine> linesUnder(const std::string& header, const std::string& path)
{
	std::vector<TDataLine> lines = readDataLines(path);
	if (lines.empty() || lines[0].text != header)
		throw CError(path, "does not begin with the header " + header, kWriteAgain);
	lines.erase(lines.begin());
	return lines;
}

std::vector<std::string> cellsOf(const TDataLine& line, size_t wanted)
{
	const auto cells = line.cellsByComma();
	if (cells.size() != wanted)
		line.fail(std::to_string(cells.size()) + " cells instead of " + std::to_string(wanted), kWriteAgain);
	return cells;
}
}  // namespace posidonia
