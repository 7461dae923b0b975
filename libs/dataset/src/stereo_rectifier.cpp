#include <posidonia/base/error.h>
#include <posidonia/dataset/stereo_rectifier.h>
#include <posidonia/geometry/se3.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace posidonia
{
using Eigen::Isometry3d;

namespace
{
cv::Mat toCv(const Eigen::Matrix3d& M)
{
	cv::Mat out(3, 3, CV_64F);
	for (int r = 0; r < 3; r++)
		for (int c = 0; c < 3; c++)
			out.at<double>(r, c) = M(r, c);
	return out;
}

cv::Mat matrixOf(const TRawCamera& c)
{
	return (cv::Mat_<double>(3, 3) << c.fu, 0, c.cu, 0, c.fv, c.cv, 0, 0, 1);
}

bool isDistorted(const TRawCamera& c)
{
	return std::any_of(c.distortion.begin(), c.distortion.end(), [](double k) { return k != 0; });
}

/** Would an aligned rig move a pixel by less than 0.01? The yaml's digits allow no more. */
bool isAligned(const TRawCamera& l, const TRawCamera& r, const Isometry3d& T_left_right)
{
	const double pixel = 0.01;
	const Eigen::Vector3d t = T_left_right.translation();
	const bool same = std::abs(l.fu - r.fu) < pixel && std::abs(l.fv - r.fv) < pixel &&
					  std::abs(l.cu - r.cu) < pixel && std::abs(l.cv - r.cv) < pixel;
	const bool parallel = logSO3(T_left_right.linear()).norm() * l.fu < pixel;
	return same && parallel && std::hypot(t.y(), t.z()) / t.norm() * l.fu < pixel;
}

std::vector<double> distortionOf(const CSensorYaml& yaml)
{
	const std::string text = yaml.text("distortion_coefficients");
	const auto commas = static_cast<size_t>(std::count(text.begin(), text.end(), ','));
	return yaml.numbers("distortion_coefficients", commas == 4 ? 5 : 4);
}

void requireModel(const CSensorYaml& yaml, const std::string& key, const std::vector<std::string>& names)
{
	if (!yaml.has(key) || std::count(names.begin(), names.end(), yaml.text(key))) return;
	throw CError(yaml.where(key), key + ": '" + yaml.text(key) + "' is not supported", "use " + names[0]);
}
}  // namespace

TRawCamera TRawCamera::fromYaml(const std::string& path, std::vector<std::string>& warnings)
{
	const CSensorYaml yaml(path);
	requireModel(yaml, "camera_model", {"pinhole"});
	requireModel(yaml, "distortion_model", {"radial-tangential", "radtan", "plumb_bob", "none"});
	TRawCamera camera;
	const auto size = yaml.numbers("resolution", 2), intrinsics = yaml.numbers("intrinsics", 4);
	camera.width = static_cast<int>(size[0]);
	camera.height = static_cast<int>(size[1]);
	camera.fu = intrinsics[0], camera.fv = intrinsics[1], camera.cu = intrinsics[2],
	camera.cv = intrinsics[3];
	if (camera.width < 16 || camera.height < 16 || camera.width != size[0] || camera.height != size[1])
		throw CError(yaml.where("resolution"), "resolution must be whole numbers >= 16 [px]", "mend it");
	if (camera.fu <= 0 || camera.fv <= 0)
		throw CError(
			yaml.where("intrinsics"), "focal lengths must be > 0 [px]", "intrinsics: [fu, fv, cu, cv]");
	if (yaml.has("distortion_coefficients")) camera.distortion = distortionOf(yaml);
	camera.T_BS = yaml.pose("T_BS");
	camera.rate = yaml.number("rate_hz");
	if (camera.rate <= 0) throw CError(yaml.where("rate_hz"), "rate_hz must be > 0", "mend it");
	for (const auto& message : yaml.unknownKeys(
			 {"sensor_type", "comment", "T_BS", "rate_hz", "resolution", "camera_model", "intrinsics",
			  "distortion_model", "distortion_coefficients"}))
		warnings.push_back(message);
	return camera;
}

CStereoRectifier::CStereoRectifier(
	const TRawCamera& left, const TRawCamera& right, bool cubic, const std::string& where)
	: m_interpolation(cubic ? cv::INTER_CUBIC : cv::INTER_LINEAR)
{
	if (left.width != right.width || left.height != right.height)
		throw CError(
			where, "cam0 and cam1 have different resolutions", "the pictures of a pair must be of one size");
	const Isometry3d T_left_right = left.T_BS.inverse() * right.T_BS;
	const Eigen::Vector3d t = T_left_right.translation();
	if (t.x() <= 0 || t.x() < 0.7 * t.norm())
		throw CError(
			where, "cam1 is not to the right of cam0 (its x axis)",
			"check T_BS of both, or swap the cameras");
	m_identity = !isDistorted(left) && !isDistorted(right) && isAligned(left, right, T_left_right);
	if (m_identity)
		m_camera = {left.width, left.height, left.fu, left.fv, left.cu, left.cv, t.norm()};
	else
		compute(left, right, where);
}

void CStereoRectifier::compute(const TRawCamera& left, const TRawCamera& right, const std::string& where)
{
	const cv::Size size(left.width, left.height);
	const Isometry3d T_right_left = right.T_BS.inverse() * left.T_BS;
	const cv::Mat t =
		(cv::Mat_<double>(3, 1) << T_right_left.translation().x(), T_right_left.translation().y(),
		 T_right_left.translation().z());
	cv::Mat R[2], P[2], Q;
	cv::stereoRectify(
		matrixOf(left), left.distortion, matrixOf(right), right.distortion, size, toCv(T_right_left.linear()),
		t, R[0], R[1], P[0], P[1], Q, cv::CALIB_ZERO_DISPARITY, 0, size);
	const TRawCamera* raw[] = {&left, &right};
	for (int side = 0; side < 2; side++)
		cv::initUndistortRectifyMap(
			matrixOf(*raw[side]), raw[side]->distortion, R[side], P[side], size, CV_32FC1, m_map_x[side],
			m_map_y[side]);
	const double f = P[0].at<double>(0, 0);
	m_camera = {
		left.width,
		left.height,
		f,
		P[0].at<double>(1, 1),
		P[0].at<double>(0, 2),
		P[0].at<double>(1, 2),
		-P[1].at<double>(0, 3) / f};
	if (!(f > 0) || !(m_camera.baseline > 0))
		throw CError(
			where, "the rig can't be rectified: no focal length or baseline > 0 comes out",
			"check its calibration");
	for (int r = 0; r < 3; r++)
		for (int c = 0; c < 3; c++)
			m_rotation(c, r) = R[0].at<double>(r, c);  // OpenCV's R[0] is R_rectified_raw
}

cv::Mat CStereoRectifier::rectified(const cv::Mat& grey, bool right_side) const
{
	if (m_identity) return grey;
	const int side = right_side ? 1 : 0;
	cv::Mat out;
	cv::remap(grey, out, m_map_x[side], m_map_y[side], m_interpolation, cv::BORDER_CONSTANT, 0);
	return out;
}
}  // namespace posidonia
