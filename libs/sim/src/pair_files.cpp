#include <posidonia/sim/pair_files.h>
#include <posidonia/sim/png_file.h>

namespace posidonia
{
using mrpt::obs::CObservationStereoImages;

uint64_t writePictures(
	const TGreyPair& pictures, const CObservationStereoImages& pair, const std::string& folder)
{
	return writePng(folder + "/" + pair.imageLeft.getExternalStorageFile(), pictures.left) +
		   writePng(folder + "/" + pair.imageRight.getExternalStorageFile(), pictures.right);
}

uint64_t writeDepths(const cv::Mat1f& metres, const CObservationStereoImages& pair, const std::string& folder)
{
	cv::Mat1w millimetres(metres.size());
	for (int v = 0; v < metres.rows; v++)
		for (int u = 0; u < metres.cols; u++) {
			const float mm = 1000 * metres(v, u);
			millimetres(v, u) = mm > 0 && mm < 65535 ? static_cast<uint16_t>(mm + 0.5f) : uint16_t(0);
		}
	std::string name = pair.imageLeft.getExternalStorageFile();
	name.replace(name.rfind("_left"), std::string::npos, "_depth.png");
	return writePng(folder + "/" + name, millimetres);
}
}  // namespace posidonia
