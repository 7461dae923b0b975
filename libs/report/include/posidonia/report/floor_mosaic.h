#pragma once

#include <posidonia/report/run_data.h>

#include <opencv2/core.hpp>
#include <optional>

namespace posidonia
{
/** The floor as the vehicle saw it: key frames laid on one level plane. Row 0 is the northern edge, column 0
 * the western one. */
struct TFloorMosaic
{
	cv::Mat1b image;
	cv::Mat1b seen;	 ///< 255 where some picture shows the floor, else 0
	double north_min{0}, north_max{0}, east_min{0}, east_max{0};  ///< Of its edges [m]
	double depth{0};											  ///< Of the plane [m]
	int pictures{0};
};

struct TMosaicOptions
{
	int max_pixels{1400};	  ///< On the longer side
	double resolution{0.01};  ///< At best [m/px]
	size_t max_pictures{1500};
};

/** Lays the pictures of run.nodes, evenly thinned to max_pictures, at their final poses. Where several show a
 * place, the one that has it nearest to its centre wins. The light's fall to the edges, the same in all
 * pictures, is divided out by their mean. Empty where the run has no camera or no picture. */
std::optional<TFloorMosaic> floorMosaic(const TRunData& run, const TMosaicOptions& options = {});
}  // namespace posidonia
