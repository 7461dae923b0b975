#include "overview.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace posidonia
{
using Eigen::Vector2d;

namespace
{
const cv::Scalar kWay(40, 40, 230), kPaper(255, 255, 255), kInk(0, 0, 0);
constexpr int kLargest = 1600;	///< [px]

/** North up, `metres_per_pixel` wide pixels, the origin in the middle. */
struct TMap
{
	cv::Mat3b picture;
	double metres_per_pixel;

	Vector2d northEast(int u, int v) const
	{
		return {
			((picture.rows - 1) / 2.0 - v) * metres_per_pixel,
			(u - (picture.cols - 1) / 2.0) * metres_per_pixel};
	}
	cv::Point2d pixel(double north, double east) const
	{
		return {
			(picture.cols - 1) / 2.0 + east / metres_per_pixel,
			(picture.rows - 1) / 2.0 - north / metres_per_pixel};
	}
};

TMap textureMap(const CFloorTexture& texture)
{
	const cv::Mat& full = texture.levels().front();
	const double shrink = std::min(1.0, static_cast<double>(kLargest) / std::max(full.cols, full.rows));
	cv::Mat small, colour;
	cv::resize(full, small, {}, shrink, shrink, cv::INTER_AREA);
	cv::cvtColor(small, colour, cv::COLOR_GRAY2BGR);
	return {colour, texture.resolution() / shrink};
}

/** Light from the north-west, 45 degrees high; level floor keeps its grey. */
void shade(const CSeaFloor& floor, TMap& map)
{
	const size_t width = static_cast<size_t>(map.picture.cols);
	const Eigen::Vector3d to_light(0.5, -0.5, -std::sqrt(0.5));
	std::vector<float> north(width), east(width);
	CSeaFloor::TGradients slope(width);
	for (int v = 0; v < map.picture.rows; v++) {
		for (size_t u = 0; u < width; u++) {
			const Eigen::Vector2f p = map.northEast(static_cast<int>(u), v).cast<float>();
			north[u] = p.x(), east[u] = p.y();
		}
		floor.gradientsAt(north, east, slope);
		for (size_t u = 0; u < width; u++) {
			const Eigen::Vector3f up(slope.per_north[u], slope.per_east[u], -1);
			map.picture(v, static_cast<int>(u)) *=
				std::max(0.0, up.cast<double>().normalized().dot(to_light)) / std::sqrt(0.5);
		}
	}
}

/** The largest of 1, 2, 5 x 10^n that is not above `most`. */
double roundNumber(double most)
{
	const double power = std::pow(10, std::floor(std::log10(most)));
	return power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
}

cv::Mat1d depthsOf(const CSeaFloor& floor, const TMap& map)
{
	cv::Mat1d depth(map.picture.size());
	for (int v = 0; v < depth.rows; v++)
		for (int u = 0; u < depth.cols; u++)
			depth(v, u) = floor.depthAt(map.northEast(u, v));
	return depth;
}

/** Lines of equal depth, about six; returns their distance [m], 0 on level floor. */
double drawContours(const CSeaFloor& floor, TMap& map)
{
	cv::Mat1d depth = depthsOf(floor, map);
	cv::GaussianBlur(depth, depth, {}, 0.05 / map.metres_per_pixel + 1);  // ripples would blacken the map
	double low, high;
	cv::minMaxLoc(depth, &low, &high);
	if (high - low < 1e-3) return 0;
	const double step = roundNumber((high - low) / 5);
	const auto band = [&](int v, int u) { return std::floor(depth(v, u) / step); };
	for (int v = 1; v < depth.rows; v++)
		for (int u = 1; u < depth.cols; u++)
			if (band(v, u) != band(v - 1, u) || band(v, u) != band(v, u - 1))
				map.picture(v, u) = cv::Vec3b(200, 220, 60);
	return step;
}

void drawWay(const std::vector<Eigen::Vector3d>& way, TMap& map)
{
	for (size_t i = 1; i < way.size(); i++)
		cv::line(
			map.picture, map.pixel(way[i - 1].x(), way[i - 1].y()), map.pixel(way[i].x(), way[i].y()), kWay,
			2, cv::LINE_AA);
	if (!way.empty())
		cv::circle(map.picture, map.pixel(way[0].x(), way[0].y()), 6, kWay, cv::FILLED, cv::LINE_AA);
}

void write(TMap& map, const std::string& text, const cv::Point& at)
{
	for (const auto& [colour, width] : {std::pair(kInk, 4), std::pair(kPaper, 1)})
		cv::putText(map.picture, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.7, colour, width, cv::LINE_AA);
}

/** A bar of a round length, with what the contours stand for. */
void drawScale(double contour_step, TMap& map)
{
	const double metres = roundNumber(map.picture.cols * map.metres_per_pixel / 4);
	const int length = static_cast<int>(metres / map.metres_per_pixel), v = map.picture.rows - 24;
	cv::rectangle(map.picture, {20, v}, {20 + length, v + 8}, kInk, 3);
	cv::rectangle(map.picture, {20, v}, {20 + length, v + 8}, kPaper, cv::FILLED);
	char text[80];
	if (contour_step > 0)
		std::snprintf(text, sizeof text, "%g m, north up; contours each %g m", metres, contour_step);
	else
		std::snprintf(text, sizeof text, "%g m, north up", metres);
	write(map, text, {20, v - 10});
}
}  // namespace

cv::Mat overviewOf(
	const CFloorTexture& texture, const CSeaFloor& floor, const std::vector<Eigen::Vector3d>& way)
{
	TMap map = textureMap(texture);
	shade(floor, map);
	const double contour_step = drawContours(floor, map);
	drawWay(way, map);
	drawScale(contour_step, map);
	return map.picture;
}
}  // namespace posidonia
