#include <posidonia/base/error.h>
#include <posidonia/vision/key_frame_extractor.h>
#include <posidonia/vision/light_fall.h>
#include <posidonia/vision/patch_alignment.h>
#include <posidonia/vision/stereo_matching.h>

#include <algorithm>
#include <cmath>
#include <future>

namespace posidonia
{
namespace
{
/** Half-sizes [px] of aligned patches: smaller ones are noise, larger ones bridge relief. */
constexpr int MIN_PATCH_RADIUS = 5, MAX_PATCH_RADIUS = 11;
/** How far the alignment may move from the detectors' disparity [px] at the finest scale. */
constexpr double ALIGNMENT_REACH = 1.5;
}  // namespace

CKeyFrameExtractor::CKeyFrameExtractor(const TFeatureOptions& options, const TStereoCamera& camera)
	: m_options(options), m_camera(camera)
{
	options.check();
	if (!(camera.fx > 0 && camera.fy > 0 && camera.baseline > 0))
		throw CError(
			"stereo camera", "focal lengths and baseline must be > 0",
			"the right camera lies at +baseline on the left camera's x axis");
	m_min_disparity = camera.fx * camera.baseline / options.max_depth;
	m_max_disparity = camera.fx * camera.baseline / options.min_depth;
}

void CKeyFrameExtractor::checkImage(const cv::Mat& image, const char* side) const
{
	if (image.type() == CV_8UC1 && image.cols == m_camera.width && image.rows == m_camera.height) return;
	throw CError(
		std::string(side) + " image",
		"is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) + " of OpenCV type " +
			std::to_string(image.type()) + ", the calibration says " + std::to_string(m_camera.width) + "x" +
			std::to_string(m_camera.height) + " grey, 8 bit",
		"convert and rectify it first");
}

std::optional<CKeyFrameExtractor::TMeasured> CKeyFrameExtractor::measure(
	const CPatchAligner& aligner, const cv::KeyPoint& left, const cv::KeyPoint& right, double octave) const
{
	const int radius = std::clamp(
		static_cast<int>(std::lround(m_options.patch_scale * left.size)), MIN_PATCH_RADIUS, MAX_PATCH_RADIUS);
	const auto a = aligner.align(
		left.pt.x, left.pt.y, left.pt.x - right.pt.x, radius, ALIGNMENT_REACH * std::exp2(octave));
	if (!a || a->ncc < m_options.min_ncc || a->disparity < m_min_disparity || a->disparity > m_max_disparity)
		return {};
	Eigen::Vector3d uvd(left.pt.x, left.pt.y, a->disparity);
	if (m_options.average_left_right) {
		// The right detection, carried to the left image by the better disparity, is a second look at the
		// place.
		uvd.x() = 0.5 * (uvd.x() + right.pt.x + a->disparity);
		uvd.y() = 0.5 * (uvd.y() + right.pt.y);
	}
	const double sigma_uv = m_options.positionSigma(octave);
	const double sigma_d = std::hypot(m_options.sigma_disparity, m_options.disparity_noise_scale * a->sigma);
	return TMeasured{makeStereoPoint(m_camera, uvd, sigma_uv, sigma_d, octave), a->contrast};
}

std::vector<std::optional<CKeyFrameExtractor::TMeasured>> CKeyFrameExtractor::measureAll(
	const CPatchAligner& aligner, const TFeatures& left, const TFeatures& right,
	const std::vector<std::pair<int, int>>& pairs) const
{
	std::vector<std::optional<TMeasured>> points(pairs.size());
	const auto half = [&](size_t first, size_t last) {
		for (size_t k = first; k < last; k++) {
			const auto& [i, j] = pairs[k];
			points[k] = measure(aligner, left.key_points[i], right.key_points[j], left.octaves[i]);
		}
	};
	auto second = std::async(std::launch::async, half, pairs.size() / 2, pairs.size());
	half(0, pairs.size() / 2);
	second.get();
	return points;
}

void CKeyFrameExtractor::correctLightFall(std::vector<std::optional<TMeasured>>& points) const
{
	const CLightFall fall(m_camera.width, m_camera.height);
	std::vector<CLightFall::TSample> samples;
	for (const auto& p : points)
		if (p) samples.push_back({p->point.uvr, p->contrast});
	const double slope = fall.slopeOf(samples);
	for (auto& p : points) {
		if (!p) continue;
		const TStereoPoint& q = p->point;
		Eigen::Vector3d uvd = q.uvd();
		uvd.head<2>() -= fall.pull(uvd.head<2>(), q.octave, slope);
		p->point = makeStereoPoint(m_camera, uvd, q.sigma_uv, q.sigma_d, q.octave);
	}
}

TKeyFrame CKeyFrameExtractor::extract(const cv::Mat& left, const cv::Mat& right) const
{
	checkImage(left, "left");
	checkImage(right, "right");
	auto right_features = std::async(std::launch::async, [&] { return detectFeatures(right, m_options); });
	const TFeatures l = detectFeatures(left, m_options);
	const TFeatures r = right_features.get();

	TKeyFrame frame;
	frame.binary = isBinaryDetector(m_options.detector);
	frame.detected_left = static_cast<int>(l.key_points.size());
	frame.detected_right = static_cast<int>(r.key_points.size());
	const auto pairs = matchRows(l, r, m_options, m_min_disparity, m_max_disparity);
	auto points = measureAll(CPatchAligner(left, right), l, r, pairs);
	if (m_options.correct_light_fall && m_options.detector == "SIFT") correctLightFall(points);
	std::vector<int> rows;
	for (size_t k = 0; k < pairs.size(); k++)
		if (points[k]) {
			frame.points.push_back(points[k]->point);
			rows.push_back(pairs[k].first);
		}
	frame.descriptors.create(static_cast<int>(rows.size()), l.descriptors.cols, CV_8U);
	for (size_t k = 0; k < rows.size(); k++)
		l.descriptors.row(rows[k]).copyTo(frame.descriptors.row(static_cast<int>(k)));
	return frame;
}
}  // namespace posidonia
