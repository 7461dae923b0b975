#include <posidonia/base/options.h>

#include <cmath>
#include <cstdio>

namespace posidonia
{
namespace
{
/** Shortest of 15 or 17 digits that reads back the same. */
std::string shortest(double x)
{
	char buffer[32];
	std::snprintf(buffer, sizeof buffer, "%.15g", x);
	if (std::stod(buffer) != x) std::snprintf(buffer, sizeof buffer, "%.17g", x);
	return buffer;
}
}  // namespace

std::string TRange::text() const
{
	const bool has_min = std::isfinite(min), has_max = std::isfinite(max);
	if (has_min && has_max) return "must be in [" + shortest(min) + ", " + shortest(max) + "]";
	if (has_min) return std::string("must be ") + (open_min ? "> " : ">= ") + shortest(min);
	if (has_max) return "must be <= " + shortest(max);
	return "any number";
}

void COptionLister::number(const char* key, double& value, const TRange& range, const char* text)
{
	rows.push_back({key, shortest(value), range.text(), text});
}
void COptionLister::degrees(const char* key, double& radians, const TRange& range_deg, const char* text)
{
	rows.push_back({key, shortest(radians * 180.0 / M_PI), range_deg.text(), text});
}
void COptionLister::integer(const char* key, int& value, const TRange& range, const char* text)
{
	rows.push_back({key, std::to_string(value), range.text(), text});
}
void COptionLister::seed(const char* key, unsigned& value, const char* text)
{
	rows.push_back({key, std::to_string(value), "any whole number >= 0", text});
}
void COptionLister::flag(const char* key, bool& value, const char* text)
{
	rows.push_back({key, value ? "true" : "false", "true or false", text});
}
void COptionLister::text(const char* key, std::string& value, const char* text)
{
	rows.push_back({key, value, "text", text});
}
void COptionLister::choice(
	const char* key, std::string& value, const std::vector<std::string>& names, const char* text)
{
	std::string range = "one of";
	for (const auto& name : names)
		range += " " + name;
	rows.push_back({key, value, range, text});
}
void COptionLister::numbers(
	const char* key, std::vector<double>& values, size_t n, const TRange& range, const char* text)
{
	std::string list;
	for (double x : values)
		list += (list.empty() ? "" : " ") + shortest(x);
	rows.push_back(
		{key, list, (n ? std::to_string(n) : std::string("some")) + " numbers, each " + range.text(), text});
}
}  // namespace posidonia
