#include "floor_renderer.h"

#include <posidonia/geometry/se3.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace posidonia::testing
{
namespace
{
cv::Mat gaussianField(int rows, int cols, double sigma, unsigned seed)
{
	cv::Mat field(rows, cols, CV_32F);
	cv::RNG rng(seed);
	rng.fill(field, cv::RNG::NORMAL, 0, sigma);
	return field;
}

cv::Mat withNoise(const cv::Mat& image, double sigma, unsigned seed)
{
	cv::Mat out = image + gaussianField(image.rows, image.cols, sigma, seed);
	out.convertTo(out, CV_8U);
	return out;
}
}  // namespace

CFloorRenderer::CFloorRenderer(const cv::Mat& texture, double metres_per_pixel, const TStereoCamera& camera)
	: m_texture(texture), m_metres_per_pixel(metres_per_pixel), m_camera(camera)
{
}

cv::Mat CFloorRenderer::proceduralTexture(int size, unsigned seed)
{
	cv::Mat sum(size, size, CV_32F, cv::Scalar(120));
	double amplitude = 9;
	for (int cell = 2; cell <= 128; cell *= 2, amplitude *= 1.1) {
		cv::Mat octave;
		cv::resize(
			gaussianField(size / cell, size / cell, amplitude, seed + cell), octave, sum.size(), 0, 0,
			cv::INTER_CUBIC);
		sum += octave;
	}
	sum.convertTo(sum, CV_8U);
	return sum;
}

std::optional<cv::Mat> CFloorRenderer::reefPhotograph()
{
	const char* folder = std::getenv("POSIDONIA_DATA");
	const std::string data = folder ? folder : POSIDONIA_SOURCE_DIR "/../shared/data";
	const std::string path = data + "/posters/noaa_reef_5472x3648.jpg";
	if (!std::filesystem::exists(path)) return {};
	return cv::imread(path, cv::IMREAD_GRAYSCALE);
}

Eigen::Isometry3d CFloorRenderer::pose(
	double x, double y, double altitude, double yaw, double pitch, double roll)
{
	Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
	T.translation() << x, y, -altitude;
	T.linear() = rotationFromYawPitchRoll(yaw, pitch, roll);
	return T;
}

cv::Mat CFloorRenderer::view(const Eigen::Isometry3d& T) const
{
	constexpr int FINER = 2;
	cv::Mat map(m_camera.height * FINER, m_camera.width * FINER, CV_32FC2);
	for (int i = 0; i < map.rows; i++)
		for (int j = 0; j < map.cols; j++) {
			const double u = (j + 0.5) / FINER - 0.5, v = (i + 0.5) / FINER - 0.5;
			const Eigen::Vector3d ray =
				T.linear() *
				Eigen::Vector3d((u - m_camera.cx) / m_camera.fx, (v - m_camera.cy) / m_camera.fy, 1);
			const Eigen::Vector3d p = T.translation() - ray * (T.translation().z() / ray.z());
			map.at<cv::Vec2f>(i, j) = {
				static_cast<float>(p.x() / m_metres_per_pixel + 0.5 * m_texture.cols),
				static_cast<float>(p.y() / m_metres_per_pixel + 0.5 * m_texture.rows)};
		}
	cv::Mat fine, out;
	cv::remap(m_texture, fine, map, {}, cv::INTER_LINEAR, cv::BORDER_REFLECT);
	fine.convertTo(fine, CV_32F);
	cv::resize(fine, out, {m_camera.width, m_camera.height}, 0, 0, cv::INTER_AREA);
	return out;
}

CFloorRenderer::TPair CFloorRenderer::render(
	const Eigen::Isometry3d& T_world_left, double noise, unsigned seed) const
{
	Eigen::Isometry3d T_left_right = Eigen::Isometry3d::Identity();
	T_left_right.translation().x() = m_camera.baseline;
	return {
		withNoise(view(T_world_left), noise, 2 * seed + 1),
		withNoise(view(T_world_left * T_left_right), noise, 2 * seed + 2)};
}
}  // namespace posidonia::testing
