#pragma once

#include <string>
#include <vector>

namespace posidonia
{
/** One result. The same rows feed the text table, the CSV, metrics.json and the report. */
struct TMetric
{
	std::string what;  ///< "nodes.ate.unaligned.mean"
	std::string unit;  ///< "m", "deg", "%"; empty for a count or a ratio
	double value{0};
};
using TMetrics = std::vector<TMetric>;

/** The row's value; throws CError with the closest name when there is no such row. */
double metric(const TMetrics& rows, const std::string& what);

/** Aligned columns for a terminal. */
std::string metricsText(const TMetrics& rows);

/** Header `what,unit,value`, then a row each. */
std::string metricsCsv(const TMetrics& rows);

/** {"<what>": {"value": v, "unit": "m"}, ...} in the rows' order, values with 9 significant digits (so that
 * the last bits of a sum don't show), null when not finite. Throws CError when two rows have the same name.
 */
std::string metricsJson(const TMetrics& rows);

void writeMetricsCsv(const std::string& path, const TMetrics& rows);
void writeMetricsJson(const std::string& path, const TMetrics& rows);

/** What writeMetricsJson() wrote (null comes back as NaN); throws CError naming the file. */
TMetrics readMetricsJson(const std::string& path);
}  // namespace posidonia
