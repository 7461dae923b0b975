#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace posidonia
{
/** A picture as a PNG file, whole or not at all; returns its bytes. Throws CError. */
uint64_t writePicture(const std::string& path, const cv::Mat& picture);
}  // namespace posidonia
