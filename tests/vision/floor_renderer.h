#pragma once

#include <posidonia/geometry/stereo_camera.h>

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <random>
#include <string>

namespace posidonia::testing
{
/** A flat textured floor at z = 0 of a world with z downwards, seen by a down-looking stereo camera.
 * Grey levels are supersampled 2 x 2, then get white noise. */
class CFloorRenderer
{
   public:
	/** @param texture CV_8U, its middle at the world's origin; @param metres_per_pixel of the texture */
	CFloorRenderer(const cv::Mat& texture, double metres_per_pixel, const TStereoCamera& camera);

	/** Noise in `octaves` octaves, coarse ones stronger: something like sand and gravel. */
	static cv::Mat proceduralTexture(int size, unsigned seed);
	/** A photograph of a reef, kMetresPerPixel each. */
	static cv::Mat reefPhotograph();
	static constexpr double kMetresPerPixel = 0.0055;

	struct TPair
	{
		cv::Mat left, right;
	};
	/** @param T_world_left left camera; @param noise standard deviation [grey levels] */
	TPair render(const Eigen::Isometry3d& T_world_left, double noise, unsigned seed) const;

	/** Down-looking pose over (x, y) [m] at an altitude [m], turned by yaw, pitch, roll [rad]. */
	static Eigen::Isometry3d pose(
		double x, double y, double altitude, double yaw, double pitch = 0, double roll = 0);

   private:
	float grey(double x, double y) const;
	cv::Mat view(const Eigen::Isometry3d& T_world_camera) const;

	cv::Mat m_texture;
	double m_metres_per_pixel;
	TStereoCamera m_camera;
};
}  // namespace posidonia::testing
