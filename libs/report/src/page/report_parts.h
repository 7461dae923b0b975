#pragma once

#include <posidonia/report/run_report.h>

#include "json_columns.h"

/** The parts of a report, each as web/src/schema.ts names and describes it. `notes` gets a sentence for what
 * was left out. */
namespace posidonia
{
TJson headlineJson(const TRunData& run);
TJson metricsJson(const TRunData& run);
TJson paperTableJson(const TRunData& run);
TJson trajectoriesJson(const TRunData& run, const TReportLimits& limits, TJson& notes);
TJson errorsJson(const TRunData& run, const TReportLimits& limits);
TJson consistencyJson(const TRunData& run, const TReportLimits& limits);
TJson plotsJson(const TRunData& run, const TReportLimits& limits);
TJson cameraJson(const TRunData& run);
TJson floorJson(const std::optional<TFloorMosaic>& floor);
TJson loopsJson(const TRunData& run, const std::vector<TLoopRow>& shown, const TReportLimits& limits);
TJson refusedJson(const TRunData& run);
TJson keyFramesJson(
	const TRunData& run, const std::vector<TLoopRow>& shown, const TReportLimits& limits, TJson& notes);
TJson timingsJson(const TRunData& run);
TJson sensorsJson(const TRunData& run);
TJson eventsJson(const TRunData& run);

/** The pairs that were tried, or as many as the page holds: those with the largest residuals and, evenly,
 * others. */
std::vector<TLoopRow> loopsShown(const TRunData& run, const TReportLimits& limits, TJson& notes);
/** Indices of the rows in falling order of their residuals, unmeasured ones last. */
std::vector<size_t> byResidual(const TRunData& run, const std::vector<TLoopRow>& rows);
/** Measured against final poses: translation [m] and angle [rad]; NaN where nothing was measured. */
Eigen::Vector2d residualOf(const TRunData& run, const TLoopRow& row);
}  // namespace posidonia
