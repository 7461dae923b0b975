#pragma once

#include <posidonia/eval/metrics.h>

#include <string>
#include <vector>

namespace posidonia
{
/** The metrics.json of a run. */
struct TRunMetrics
{
	std::string run;  ///< As its owner calls it: the folder
	TMetrics metrics;
};

/** One metric over several runs. */
struct TSummaryRow
{
	std::string what, unit;
	double median{0};
	double worst{0};  ///< The largest error or number of false edges; the smallest recall or number of loops
};

/** What a set of runs (seeds of one experiment) is judged by. */
struct TSummary
{
	std::vector<TSummaryRow> rows;
	/** Metrics that are left out since some run has no value for them, each with these runs. */
	std::vector<std::string> notes;

	std::string text() const;
	TMetrics metrics() const;  ///< Rows "<what>.median" and "<what>.worst"
};

/** Throws CError when no metric is there in every run. */
TSummary summarize(const std::vector<TRunMetrics>& runs);

/** metrics.json of a run folder, or the file itself. Throws CError naming it. */
TRunMetrics readRunMetrics(const std::string& folder_or_file);
}  // namespace posidonia
