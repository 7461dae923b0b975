#pragma once

#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/obs/observations.h>

#include <cstdint>
#include <string>

namespace posidonia
{
/** Both pictures of a pair as PNG files of the names that the observation gives them; returns their bytes. */
uint64_t writePictures(
	const TGreyPair& pictures, const mrpt::obs::CObservationStereoImages& pair, const std::string& folder);

/** LABEL_000012_depth.png beside LABEL_000012_left.png: millimetres, 0 where there is none (or too far).
 * Returns its bytes. */
uint64_t writeDepths(
	const cv::Mat1f& metres, const mrpt::obs::CObservationStereoImages& pair, const std::string& folder);
}  // namespace posidonia
