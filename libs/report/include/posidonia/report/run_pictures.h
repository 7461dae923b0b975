#pragma once

#include <posidonia/report/run_data.h>

#include <string>

namespace posidonia
{
/** The plots of a run as SVG, for papers: trajectories.svg and error.svg (the paper's figure 5), and
 * node-errors.svg and nees.svg where truth and covariances are known. Written into `folder`, which is made;
 * what there is no data for is left out. */
void writeRunPictures(const TRunData& run, const std::string& folder);
}  // namespace posidonia
