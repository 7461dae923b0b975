#pragma once

#include <posidonia/eval/data_lines.h>

#include <string>
#include <vector>

/** What the tables of a run folder have in common. */
namespace posidonia
{
/** The number by a printf format. */
std::string numberText(double value, const char* format);

/** The lines below a header that must be `header`. Throws CError. */
std::vector<TDataLine> linesUnder(const std::string& header, const std::string& path);

/** The cells of a line that must have so many. Throws CError naming file and line. */
std::vector<std::string> cellsOf(const TDataLine& line, size_t wanted);

/** The way out of a damaged file. */
constexpr const char* kWriteAgain = "let the app write it again";
}  // namespace posidonia
