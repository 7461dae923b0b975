#include "floor_renderer.h"

#include <posidonia/geometry/se3.h>

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

cv::Mat CFloorRenderer::reefPhotograph()
{
	return cv::imread(POSIDONIA_SOURCE_DIR "/ini/textures/noaa_reef.jpg", cv::IMREAD_GRAYSCALE);
}

Eigen::Isometry3d CFloorRenderer::pose(
	double x, double y, double altitude, double yaw, double pitch, double roll)
{
	Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
	T.translation() << x, y, -altitude;
	T.linear() = rotationFromYawPitchRoll(yaw, pitch, roll);
	return T;
}

float CFloorRenderer::grey(double x, double y) const
{
	// Exact bilinear interpolation (cv::remap rounds places to 1/32 pixel); mirrored beyond the texture.
	const auto mirrored = [](int i, int n) {
		const int k = ((i % (2 * n)) + 2 * n) % (2 * n);
		return k < n ? k : 2 * n - 1 - k;
	};
	const double c = x / m_metres_per_pixel + 0.5 * m_texture.cols,
				 r = y / m_metres_per_pixel + 0.5 * m_texture.rows;
	const int c0 = static_cast<int>(std::floor(c)), r0 = static_cast<int>(std::floor(r));
	const float fc = static_cast<float>(c - c0), fr = static_cast<float>(r - r0);
	const uint8_t* upper = m_texture.ptr(mirrored(r0, m_texture.rows));
	const uint8_t* lower = m_texture.ptr(mirrored(r0 + 1, m_texture.rows));
	const int left = mirrored(c0, m_texture.cols), right = mirrored(c0 + 1, m_texture.cols);
	return (1 - fr) * ((1 - fc) * upper[left] + fc * upper[right]) +
		   fr * ((1 - fc) * lower[left] + fc * lower[right]);
}

cv::Mat CFloorRenderer::view(const Eigen::Isometry3d& T) const
{
	constexpr int FINER = 2;
	cv::Mat out(m_camera.height, m_camera.width, CV_32F);
	for (int i = 0; i < out.rows; i++)
		for (int j = 0; j < out.cols; j++) {
			float sum = 0;
			for (int k = 0; k < FINER * FINER; k++) {
				const double u = j + (k % FINER + 0.5) / FINER - 0.5, v = i + (k / FINER + 0.5) / FINER - 0.5;
				const Eigen::Vector3d ray =
					T.linear() *
					Eigen::Vector3d((u - m_camera.cx) / m_camera.fx, (v - m_camera.cy) / m_camera.fy, 1);
				const Eigen::Vector3d p = T.translation() - ray * (T.translation().z() / ray.z());
				sum += grey(p.x(), p.y());
			}
			out.at<float>(i, j) = sum / (FINER * FINER);
		}
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
