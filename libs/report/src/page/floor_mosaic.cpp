#include <posidonia/report/floor_mosaic.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "json_columns.h"

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
/** Nodes that have a picture and know how high they are, evenly thinned. */
std::vector<const TNodeRow*> pictured(const TRunData& run, size_t most)
{
	std::vector<const TNodeRow*> all;
	for (const TNodeRow& node : run.nodes)
		if (!node.picture.empty() && node.altitude > 0) all.push_back(&node);
	return thinned(all, most);
}

double medianFloor(const std::vector<const TNodeRow*>& nodes, const Isometry3d& T_body_camera)
{
	std::vector<double> depths;
	for (const TNodeRow* node : nodes)
		depths.push_back((node->T_map_body * T_body_camera).translation().z() + node->altitude);
	std::nth_element(depths.begin(), depths.begin() + long(depths.size() / 2), depths.end());
	return depths[depths.size() / 2];
}

/** What the mean of all pictures has more or less than its own mean: the light's fall. */
cv::Mat1f lightOf(const std::vector<cv::Mat1b>& pictures)
{
	cv::Mat1f sum(pictures.front().size(), 0.0F);
	for (const cv::Mat1b& picture : pictures)
		cv::accumulate(picture, sum);
	cv::GaussianBlur(sum, sum, {}, sum.cols / 20.0);
	sum /= std::max(1e-6, cv::mean(sum)[0]);
	cv::max(sum, 0.1, sum);
	return sum;
}

/** Lays pictures on the plane. */
class CPainter
{
   public:
	CPainter(TFloorMosaic& mosaic, double resolution)
		: m_mosaic(mosaic), m_resolution(resolution), m_weight(mosaic.image.size(), 0.0F)
	{
	}

	/** @param camera of this picture's size */
	void paint(const cv::Mat1b& picture, const TStereoCamera& camera, const Isometry3d& T_map_camera)
	{
		const cv::Rect seen = footprint(camera, T_map_camera);
		const Isometry3d T_camera_map = T_map_camera.inverse();
		for (int v = seen.y; v < seen.br().y; v++)
			for (int u = seen.x; u < seen.br().x; u++)
				paintPixel(
					picture, camera, T_camera_map * pointOf(u, v), m_mosaic.image(v, u), m_weight(v, u));
	}

	/** Where something was laid. */
	cv::Mat1b seen() const
	{
		cv::Mat1b mask;
		cv::compare(m_weight, 0, mask, cv::CMP_GT);
		return mask;
	}

   private:
	Vector3d pointOf(int u, int v) const
	{
		return {
			m_mosaic.north_max - (v + 0.5) * m_resolution, m_mosaic.east_min + (u + 0.5) * m_resolution,
			m_mosaic.depth};
	}

	static void paintPixel(
		const cv::Mat1b& picture, const TStereoCamera& camera, const Vector3d& p, uchar& pixel, float& weight)
	{
		if (p.z() < 0.05) return;
		const double x = camera.fx * p.x() / p.z(), y = camera.fy * p.y() / p.z();
		const auto near = static_cast<float>(
			1 - std::max(std::abs(x) / (camera.width / 2.0), std::abs(y) / (camera.height / 2.0)));
		if (near <= weight) return;
		const cv::Point at(cvRound(x + camera.cx), cvRound(y + camera.cy));
		if (!cv::Rect({}, picture.size()).contains(at)) return;
		weight = near;
		pixel = picture(at);
	}

	/** Pixels of the mosaic that the picture may reach: the box around its corners on the plane. */
	cv::Rect footprint(const TStereoCamera& camera, const Isometry3d& T_map_camera) const
	{
		cv::Rect box;
		for (const double u : {0.0, double(camera.width)})
			for (const double v : {0.0, double(camera.height)}) {
				const Vector3d ray = T_map_camera.linear() *
									 Vector3d((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
				if (ray.z() < 0.1) return {};  // it looks at the horizon
				const Vector3d p = T_map_camera.translation() +
								   ray * ((m_mosaic.depth - T_map_camera.translation().z()) / ray.z());
				const cv::Rect pixel(
					cvFloor((p.y() - m_mosaic.east_min) / m_resolution),
					cvFloor((m_mosaic.north_max - p.x()) / m_resolution), 1, 1);
				box = box.empty() ? pixel : box | pixel;
			}
		return box & cv::Rect({}, m_mosaic.image.size());
	}

	TFloorMosaic& m_mosaic;
	double m_resolution;
	cv::Mat1f m_weight;
};

TStereoCamera scaled(TStereoCamera camera, cv::Size size)
{
	const double s = static_cast<double>(size.width) / camera.width;
	camera.width = size.width, camera.height = size.height;
	camera.fx *= s, camera.fy *= s;
	camera.cx = (camera.cx + 0.5) * s - 0.5;
	camera.cy = (camera.cy + 0.5) * s - 0.5;
	return camera;
}

/** The plane's outline and size; returns the resolution [m/px]. */
double layOut(
	TFloorMosaic& mosaic, const std::vector<const TNodeRow*>& nodes, const TStereoCamera& camera,
	const TMosaicOptions& options)
{
	mosaic.north_min = mosaic.east_min = 1e300;
	mosaic.north_max = mosaic.east_max = -1e300;
	for (const TNodeRow* node : nodes) {
		const Vector3d p = node->T_map_body.translation();
		const double reach = node->altitude * std::hypot(camera.width, camera.height) / 2 / camera.fx;
		mosaic.north_min = std::min(mosaic.north_min, p.x() - reach);
		mosaic.north_max = std::max(mosaic.north_max, p.x() + reach);
		mosaic.east_min = std::min(mosaic.east_min, p.y() - reach);
		mosaic.east_max = std::max(mosaic.east_max, p.y() + reach);
	}
	const double north = mosaic.north_max - mosaic.north_min, east = mosaic.east_max - mosaic.east_min;
	const double resolution = std::max(options.resolution, std::max(north, east) / options.max_pixels);
	mosaic.image.create(
		std::max(1, int(std::ceil(north / resolution))), std::max(1, int(std::ceil(east / resolution))));
	mosaic.image.setTo(0);
	mosaic.north_min = mosaic.north_max - mosaic.image.rows * resolution;
	mosaic.east_max = mosaic.east_min + mosaic.image.cols * resolution;
	return resolution;
}
}  // namespace

std::optional<TFloorMosaic> floorMosaic(const TRunData& run, const TMosaicOptions& options)
{
	if (!run.camera) return {};
	std::vector<const TNodeRow*> nodes;
	std::vector<cv::Mat1b> pictures;
	for (const TNodeRow* node : pictured(run, options.max_pictures)) {
		cv::Mat1b picture = cv::imread(run.file(node->picture), cv::IMREAD_REDUCED_GRAYSCALE_2);
		if (picture.empty() || (!pictures.empty() && picture.size() != pictures.front().size())) continue;
		nodes.push_back(node);
		pictures.push_back(picture);
	}
	if (nodes.empty()) return {};
	TFloorMosaic mosaic;
	mosaic.pictures = static_cast<int>(nodes.size());
	mosaic.depth = medianFloor(nodes, run.camera->T_body_camera);
	CPainter painter(mosaic, layOut(mosaic, nodes, run.camera->camera, options));
	const TStereoCamera camera = scaled(run.camera->camera, pictures.front().size());
	const cv::Mat1f light = lightOf(pictures);
	for (size_t k = 0; k < nodes.size(); k++) {
		cv::Mat1b even;
		cv::divide(pictures[k], light, even, 1, CV_8U);
		painter.paint(even, camera, nodes[k]->T_map_body * run.camera->T_body_camera);
	}
	mosaic.seen = painter.seen();
	return mosaic;
}
}  // namespace posidonia
