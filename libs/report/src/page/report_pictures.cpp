#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <set>

#include "report_parts.h"

namespace posidonia
{
TJson cameraJson(const TRunData& run)
{
	if (!run.camera) return nullptr;
	const TStereoCamera& c = run.camera->camera;
	TJson matrix = TJson::array();
	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 4; j++)
			matrix.push_back(rounded(run.camera->T_body_camera(i, j), 6));
	return {{"width", c.width}, {"height", c.height},	  {"fx", c.fx}, {"fy", c.fy}, {"cx", c.cx},
			{"cy", c.cy},		{"T_body_camera", matrix}};
}

namespace
{
std::string jpeg(const cv::Mat& picture, int quality)
{
	std::vector<unsigned char> bytes;
	cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, quality, cv::IMWRITE_JPEG_OPTIMIZE, 1});
	return base64(bytes);
}

/** Nodes whose pictures are embedded: all, or those of the worst and of some other loops. */
std::set<int> embeddedNodes(
	const TRunData& run, const std::vector<TLoopRow>& shown, const TReportLimits& limits, TJson& notes)
{
	std::set<int> nodes;
	if (run.nodes.size() <= limits.all_key_frames) {
		for (const TNodeRow& node : run.nodes)
			nodes.insert(node.node);
		return nodes;
	}
	std::vector<size_t> order = byResidual(run, shown);
	std::vector<size_t> picked(
		order.begin(), order.begin() + long(std::min(limits.worst_loops, order.size())));
	std::vector<size_t> rest(order.begin() + long(picked.size()), order.end());
	std::shuffle(rest.begin(), rest.end(), std::mt19937(1));
	picked.insert(
		picked.end(), rest.begin(), rest.begin() + long(std::min(limits.random_loops, rest.size())));
	for (const size_t k : picked)
		nodes.insert({int(shown[k].from), int(shown[k].to)});
	notes.push_back(
		"Pictures of " + std::to_string(nodes.size()) + " of " + std::to_string(run.nodes.size()) +
		" key frames are embedded: those of the " + std::to_string(limits.worst_loops) +
		" loops with the largest residuals and of " + std::to_string(limits.random_loops) +
		" random ones; the others lie in loops/ beside this page.");
	return nodes;
}
}  // namespace

TJson keyFramesJson(
	const TRunData& run, const std::vector<TLoopRow>& shown, const TReportLimits& limits, TJson& notes)
{
	const std::set<int> embedded = embeddedNodes(run, shown, limits, notes);
	TJson out = TJson::array();
	for (const TNodeRow& node : run.nodes) {
		if (node.picture.empty()) continue;
		TJson row{{"node", node.node}, {"jpeg", nullptr}, {"file", node.picture}};
		if (embedded.count(node.node)) {
			const cv::Mat picture = cv::imread(run.file(node.picture), cv::IMREAD_GRAYSCALE);
			if (!picture.empty()) {
				const double scale = double(limits.picture_width) / picture.cols;
				cv::Mat small;
				cv::resize(picture, small, {}, scale, scale, cv::INTER_AREA);
				row["jpeg"] = jpeg(small, 70);
			}
		}
		out.push_back(row);
	}
	return out;
}

namespace
{
/** What no picture shows is transparent. */
std::string webp(const TFloorMosaic& mosaic)
{
	cv::Mat grey_and_alpha;
	cv::merge(std::vector<cv::Mat>{mosaic.image, mosaic.image, mosaic.image, mosaic.seen}, grey_and_alpha);
	std::vector<unsigned char> bytes;
	cv::imencode(".webp", grey_and_alpha, bytes, {cv::IMWRITE_WEBP_QUALITY, 70});
	return base64(bytes);
}
}  // namespace

TJson floorJson(const std::optional<TFloorMosaic>& mosaic)
{
	if (!mosaic) return nullptr;
	return {
		{"source", "mosaic of " + std::to_string(mosaic->pictures) + " key frames"},
		{"image", "data:image/webp;base64," + webp(*mosaic)},
		{"north_max", rounded(mosaic->north_max, 3)},
		{"north_min", rounded(mosaic->north_min, 3)},
		{"east_min", rounded(mosaic->east_min, 3)},
		{"east_max", rounded(mosaic->east_max, 3)},
		{"depth", rounded(mosaic->depth, 3)}};
}
}  // namespace posidonia
