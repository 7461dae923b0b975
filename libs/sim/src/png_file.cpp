#include <posidonia/sim/png_file.h>

#include <posidonia/base/files.h>

#include <opencv2/imgcodecs.hpp>

namespace posidonia
{
uint64_t writePng(const std::string& path, const cv::Mat& picture)
{
	// Sensor noise does not compress by repetition: entropy coding alone is as small and several times
	// faster.
	const std::vector<int> fast{
		cv::IMWRITE_PNG_COMPRESSION, 1, cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_HUFFMAN_ONLY};
	std::vector<uint8_t> png;
	cv::imencode(".png", picture, png, fast);
	writeFileWhole(path, [&](std::ostream& out) {
		out.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
	});
	return png.size();
}
}  // namespace posidonia
