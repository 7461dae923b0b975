#pragma once

#include <posidonia/report/floor_mosaic.h>
#include <posidonia/report/run_data.h>

#include <string>

namespace posidonia
{
/** How much of a run a page holds; what is left out is said on it. */
struct TReportLimits
{
	size_t poses{4000};			  ///< Of each trajectory and curve
	size_t loops{20000};		  ///< Rows of the list
	size_t match_lines{24};		  ///< Drawn for each pair
	size_t all_key_frames{1500};  ///< Beyond so many, only those of some loops are embedded:
	size_t worst_loops{300};	  ///< ... of the loops with the largest residuals
	size_t random_loops{300};	  ///< ... and of so many others
	int picture_width{200};		  ///< Of an embedded key frame [px]
};

/** The JSON that the page shows (web/src/schema.ts says what is in it). */
std::string runReportJson(
	const TRunData& run, const std::optional<TFloorMosaic>& floor, const TReportLimits& limits = {});

/** The page: the template with the JSON in it; opens offline, from disk. */
std::string reportPage(const std::string& title, const std::string& json);

/** All that is made of a run: plots and exports/ into `folder`, report.html into the run's own, beside its
 * pictures; each file whole. Returns the path of the page. */
std::string writeReport(const TRunData& run, const std::string& folder);
}  // namespace posidonia
