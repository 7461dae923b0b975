#include <posidonia/eval/data_lines.h>

#include <posidonia/base/error.h>
#include <posidonia/base/files.h>

#include <charconv>
#include <cmath>
#include <sstream>

namespace posidonia
{
namespace
{
std::string stripped(const std::string& text)
{
	const auto first = text.find_first_not_of(" \t\r");
	if (first == std::string::npos) return "";
	return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/** The whole cell as a number, a leading + allowed. */
template <class NUMBER>
bool parse(const std::string& cell, NUMBER& value)
{
	const char* first = cell.data() + (cell.size() > 1 && cell[0] == '+' && cell[1] != '-' ? 1 : 0);
	const char* last = cell.data() + cell.size();
	const auto result = std::from_chars(first, last, value);
	return result.ec == std::errc() && result.ptr == last;
}
}  // namespace

void TDataLine::fail(const std::string& problem, const std::string& way_out) const
{
	throw CError(path + ":" + std::to_string(number), problem, way_out);
}

std::vector<std::string> TDataLine::cellsByComma() const
{
	std::vector<std::string> cells;
	size_t start = 0;
	for (size_t comma = text.find(','); comma != std::string::npos; comma = text.find(',', start)) {
		cells.push_back(stripped(text.substr(start, comma - start)));
		start = comma + 1;
	}
	cells.push_back(stripped(text.substr(start)));
	return cells;
}

std::vector<std::string> TDataLine::cellsByBlank() const
{
	std::istringstream in(text);
	std::vector<std::string> cells;
	for (std::string cell; in >> cell;)
		cells.push_back(cell);
	return cells;
}

double TDataLine::real(const std::string& cell) const
{
	double value = 0;
	if (!parse(cell, value)) fail("'" + cell + "' is not a number", "correct or remove the line");
	if (!std::isfinite(value)) fail("'" + cell + "' is not finite", "correct or remove the line");
	return value;
}

long long TDataLine::whole(const std::string& cell) const
{
	long long value = 0;
	if (!parse(cell, value)) fail("'" + cell + "' is not a whole number", "correct or remove the line");
	return value;
}

Eigen::Matrix3d TDataLine::rotation(double x, double y, double z, double w) const
{
	const Eigen::Quaterniond q(w, x, y, z);
	if (std::abs(q.norm() - 1) > 0.01)
		fail("the quaternion's norm is " + std::to_string(q.norm()) + ", not 1", "check the columns' order");
	return q.normalized().toRotationMatrix();
}

std::vector<TDataLine> readDataLines(const std::string& path)
{
	std::istringstream in(readFileText(path));
	std::vector<TDataLine> lines;
	int number = 0;
	for (std::string raw; std::getline(in, raw);) {
		number++;
		const std::string text = stripped(raw);
		if (!text.empty() && text[0] != '#') lines.push_back({path, number, text});
	}
	return lines;
}
}  // namespace posidonia
