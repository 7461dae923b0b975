#include <mrpt/obs/CRawlog.h>
#include <posidonia/base/error.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/observations.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace posidonia
{
using mrpt::obs::CObservationStereoImages;

namespace
{
mrpt::img::TCamera toTCamera(const TStereoCamera& c)
{
	mrpt::img::TCamera camera;
	camera.ncols = static_cast<uint32_t>(c.width);
	camera.nrows = static_cast<uint32_t>(c.height);
	camera.setIntrinsicParamsFromValues(c.fx, c.fy, c.cx, c.cy);
	return camera;
}
}  // namespace

CObservationStereoImages::Ptr makeStereo(
	const std::string& label, double stamp, const TStereoSpec& spec, const std::string& left_name,
	const std::string& right_name)
{
	auto pair = CObservationStereoImages::Create();
	pair->sensorLabel = label;
	pair->timestamp = stampFrom(stamp);
	pair->leftCamera = pair->rightCamera = toTCamera(spec.camera);
	pair->cameraPose = mrpt::poses::CPose3DQuat(toMrpt(spec.T_body_sensor()));
	pair->rightCameraPose = mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(spec.camera.baseline, 0, 0));
	pair->hasImageRight = true;
	pair->imageLeft.setExternalStorage(left_name);
	pair->imageRight.setExternalStorage(right_name);
	return pair;
}

TStereoSpec stereoSpecOf(const CObservationStereoImages& pair)
{
	if (!pair.areImagesRectified() || !pair.hasImageRight)
		throw CError(
			"sensor '" + pair.sensorLabel + "'", "the stereo pair is not rectified or has no right image",
			"rectify the images first (auv-dataset2rawlog does)");
	const auto &l = pair.leftCamera, &r = pair.rightCamera;
	const bool same = l.fx() == r.fx() && l.fy() == r.fy() && l.cx() == r.cx() && l.cy() == r.cy();
	if (!same || pair.rightCameraPose.x() <= 0)
		throw CError(
			"sensor '" + pair.sensorLabel + "'",
			"the stereo pair's cameras differ or its baseline is not > 0",
			"rectify the images first, with the same intrinsics left and right");
	TStereoSpec spec;
	spec.camera.width = static_cast<int>(pair.leftCamera.ncols);
	spec.camera.height = static_cast<int>(pair.leftCamera.nrows);
	spec.camera.fx = pair.leftCamera.fx();
	spec.camera.fy = pair.leftCamera.fy();
	spec.camera.cx = pair.leftCamera.cx();
	spec.camera.cy = pair.leftCamera.cy();
	spec.camera.baseline = pair.rightCameraPose.x();
	spec.pose = TSensorMount::poseNumbers(fromMrpt(mrpt::poses::CPose3D(pair.cameraPose)));
	return spec;
}

std::string imagesFolderOf(const std::string& rawlog_path)
{
	return rawlog_path.substr(0, rawlog_path.rfind(".rawlog")) + "_Images";
}

CStereoImageLoader::CStereoImageLoader(const std::string& rawlog_path)
	: m_rawlog(rawlog_path), m_folder(imagesFolderOf(rawlog_path))
{
}

TGreyPair CStereoImageLoader::load(const CObservationStereoImages& pair) const
{
	const double stamp = stampOf(pair);
	return {loadOne(pair.imageLeft, "left", stamp), loadOne(pair.imageRight, "right", stamp)};
}

cv::Mat CStereoImageLoader::loadOne(
	const mrpt::img::CImage& image, const std::string& side, double stamp) const
{
	if (!image.isExternallyStored()) {
		const cv::Mat& embedded = image.asCvMatRef();
		if (embedded.empty() || embedded.channels() == 1) return embedded;
		cv::Mat grey;
		cv::cvtColor(embedded, grey, cv::COLOR_BGR2GRAY);
		return grey;
	}
	const std::string name = image.getExternalStorageFile();
	const std::string path = std::filesystem::path(name).is_absolute() ? name : m_folder + "/" + name;
	cv::Mat grey = cv::imread(path, cv::IMREAD_GRAYSCALE);
	if (grey.empty())
		throw CError(
			m_rawlog,
			mrpt::format(
				"stereo pair at %.6f s: %s image %s not found or not readable under %s/", stamp, side.c_str(),
				name.c_str(), m_folder.c_str()),
			"put the images folder beside the rawlog");
	return grey;
}
}  // namespace posidonia
