#include <posidonia/vision/features.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <utility>

namespace posidonia
{
namespace
{
/** Detectors give up to this many times the wanted number (each costs its descriptor), for the grid to choose
 * from. */
constexpr double GRID_CHOICE = 1.5;

cv::Ptr<cv::Feature2D> makeDetector(const TFeatureOptions& o)
{
	const int offered = static_cast<int>(GRID_CHOICE * o.max_features);
	if (o.detector == "SIFT") return cv::SIFT::create(offered, 3, o.sift_contrast);
	if (o.detector == "AKAZE")
		return cv::AKAZE::create(
			cv::AKAZE::DESCRIPTOR_MLDB, 0, 3, static_cast<float>(o.akaze_threshold), 4, 4,
			cv::KAZE::DIFF_PM_G2);
	return cv::ORB::create(offered, 1.2f, 8, 15, 0, 2, cv::ORB::HARRIS_SCORE, 31, o.orb_fast_threshold);
}

/** Size [px] of the detector's finest key points. */
double smallestSize(const std::string& detector)
{
	if (detector == "SIFT") return 2.0;
	return detector == "ORB" ? 31.0 : 4.8;
}

/** Moves a key point to where the detector saw it; pixel centres are at whole numbers.
 * OpenCV's SIFT doubles the image (sample X lies at X/2 - 1/4) but reports X/2, and its ORB shrinks by s
 * (sample X lies at (X + 1/2) s - 1/2) but reports X s. Left alone, that is 0.35 px between opposite
 * headings, all to one side. */
void correctPosition(cv::KeyPoint& k, const std::string& detector)
{
	float shift = 0;
	if (detector == "SIFT") shift = -0.25f;
	if (detector == "ORB") shift = 0.5f * (k.size / 31.0f - 1);
	k.pt += cv::Point2f(shift, shift);
}

/** Strongest first; a total order, so that no sort depends on the order of detection. */
bool strongerThan(const cv::KeyPoint& a, const cv::KeyPoint& b)
{
	return std::tie(b.response, a.pt.y, a.pt.x, a.size, a.angle, a.octave) <
		   std::tie(a.response, b.pt.y, b.pt.x, b.size, b.angle, b.octave);
}

bool beforeInImage(const cv::KeyPoint& a, const cv::KeyPoint& b)
{
	return std::tie(a.pt.y, a.pt.x, b.response, a.size, a.angle, a.octave) <
		   std::tie(b.pt.y, b.pt.x, a.response, b.size, b.angle, b.octave);
}

/** The image that the detector sees: shrunk as the options say, equalised if told so. */
cv::Mat prepared(const cv::Mat& image, const TFeatureOptions& o, bool equalise)
{
	cv::Mat out = image;
	if (equalise) cv::createCLAHE(o.clahe_clip, cv::Size(8, 8))->apply(image, out = cv::Mat());
	if (o.shrink > 1) cv::resize(out, out, out.size() / o.shrink, 0, 0, cv::INTER_AREA);
	return out;
}

/** A key point of the prepared image, in pixels of the whole one: a shrunk pixel covers `shrink` whole ones.
 */
cv::KeyPoint inWholeImage(cv::KeyPoint k, const TFeatureOptions& o)
{
	correctPosition(k, o.detector);
	const auto s = static_cast<float>(o.shrink);
	k.pt = cv::Point2f((k.pt.x + 0.5f) * s - 0.5f, (k.pt.y + 0.5f) * s - 0.5f);
	k.size *= s;
	return k;
}

/** Key points of the prepared image and their descriptors; a picture that gives too few (sand, turbid water)
 * is equalised and searched again. Detection and description in one call: SIFT's and ORB's pyramids are built
 * once, and no descriptor ever meets another detector's key points. */
std::pair<std::vector<cv::KeyPoint>, cv::Mat> detectAndDescribe(
	const cv::Mat& image, const TFeatureOptions& options)
{
	std::vector<cv::KeyPoint> key_points;
	cv::Mat descriptors;
	const auto detector = makeDetector(options);
	const auto search = [&](bool equalise) {
		detector->detectAndCompute(prepared(image, options, equalise), {}, key_points, descriptors);
	};
	search(options.clahe);
	const bool poor = static_cast<double>(key_points.size()) < options.poor_picture * options.max_features;
	if (poor && !options.clahe) search(true);
	return {std::move(key_points), descriptors};
}
}  // namespace

bool isBinaryDetector(const std::string& detector)
{
	return detector != "SIFT";
}

std::vector<int> spreadOverGrid(
	const std::vector<cv::KeyPoint>& key_points, cv::Size image, int columns, int rows, int n)
{
	std::vector<int> order(key_points.size());
	std::iota(order.begin(), order.end(), 0);
	std::sort(
		order.begin(), order.end(), [&](int i, int j) { return strongerThan(key_points[i], key_points[j]); });

	std::vector<int> taken(columns * rows, 0), chosen, rest;
	const int share = n / (columns * rows);
	const auto cell = [](double x, int cells, int size) {
		return std::clamp(static_cast<int>(x * cells / size), 0, cells - 1);
	};
	for (const int i : order) {
		const cv::Point2f p = key_points[i].pt;
		const int column = cell(p.x, columns, image.width);
		const int row = cell(p.y, rows, image.height);
		const bool within_share = taken[row * columns + column]++ < share;
		(within_share ? chosen : rest).push_back(i);
	}
	const size_t missing = std::min(rest.size(), n - chosen.size());
	chosen.insert(chosen.end(), rest.begin(), rest.begin() + missing);
	std::sort(chosen.begin(), chosen.end(), [&](int i, int j) {
		return beforeInImage(key_points[i], key_points[j]);
	});
	return chosen;
}

TFeatures detectFeatures(const cv::Mat& image, const TFeatureOptions& options)
{
	auto [all, descriptors] = detectAndDescribe(image, options);
	for (auto& k : all)
		k = inWholeImage(k, options);

	TFeatures features;
	const auto chosen =
		spreadOverGrid(all, image.size(), options.grid_columns, options.grid_rows, options.max_features);
	if (chosen.empty()) return features;
	features.descriptors.create(static_cast<int>(chosen.size()), descriptors.cols, CV_8U);
	for (size_t row = 0; row < chosen.size(); row++) {
		const cv::KeyPoint& k = all[chosen[row]];
		features.key_points.push_back(k);
		features.octaves.push_back(std::max(0.0, std::log2(k.size / smallestSize(options.detector))));
		// SIFT's floats are whole numbers 0..255: nothing is lost.
		cv::Mat target = features.descriptors.row(static_cast<int>(row));
		descriptors.row(chosen[row]).convertTo(target, CV_8U);
	}
	return features;
}
}  // namespace posidonia
