#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace posidonia
{
/** Writes a picture as PNG, whole or not at all; returns its bytes. */
uint64_t writePng(const std::string& path, const cv::Mat& picture);
}  // namespace posidonia
