#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/metrics.h>
#include <posidonia/eval/number_text.h>
#include <posidonia/eval/text_table.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace posidonia
{
using nlohmann::ordered_json;

namespace
{
constexpr int kDigits = 9;

ordered_json jsonValue(double value)
{
	if (!std::isfinite(value)) return nullptr;
	if (value == std::round(value) && std::abs(value) < 1e9) return static_cast<long long>(value);
	return std::stod(significantText(value, kDigits));
}

TMetric metricOf(const std::string& what, const ordered_json& entry)
{
	const auto& value = entry.at("value");
	return {
		what, entry.at("unit").get<std::string>(),
		value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>()};
}
}  // namespace

double metric(const TMetrics& rows, const std::string& what)
{
	std::vector<std::string> names;
	for (const auto& row : rows) {
		if (row.what == what) return row.value;
		names.push_back(row.what);
	}
	throw CError("metrics", "no row '" + what + "'", didYouMean(what, names));
}

std::string metricsText(const TMetrics& rows)
{
	CTextTable table({"what", "value", "unit"});
	for (const auto& row : rows)
		table.add({row.what, significantText(row.value, 6), row.unit});
	return table.text();
}

std::string metricsCsv(const TMetrics& rows)
{
	std::string text = "what,unit,value\n";
	for (const auto& row : rows)
		text += row.what + ',' + row.unit + ',' + significantText(row.value, kDigits) + '\n';
	return text;
}

std::string metricsJson(const TMetrics& rows)
{
	ordered_json json = ordered_json::object();
	for (const auto& row : rows) {
		if (json.contains(row.what))
			throw CError("metrics", "two rows named '" + row.what + "'", "use two prefixes");
		json[row.what] = {{"value", jsonValue(row.value)}, {"unit", row.unit}};
	}
	return json.dump(1, '\t') + '\n';
}

void writeMetricsCsv(const std::string& path, const TMetrics& rows)
{
	writeFileWhole(path, [&](std::ostream& out) { out << metricsCsv(rows); });
}

void writeMetricsJson(const std::string& path, const TMetrics& rows)
{
	writeFileWhole(path, [&](std::ostream& out) { out << metricsJson(rows); });
}

TMetrics readMetricsJson(const std::string& path)
{
	const std::string text = readFileText(path);
	try {
		TMetrics rows;
		const ordered_json json = ordered_json::parse(text);
		for (const auto& [what, entry] : json.items())
			rows.push_back(metricOf(what, entry));
		return rows;
	}
	catch (const nlohmann::json::exception& e) {
		throw CError(path, std::string("is not a metrics file: ") + e.what(), "write it again with auv-eval");
	}
}
}  // namespace posidonia
