#pragma once

#include <posidonia/geometry/stereo_camera.h>

#include <Eigen/Dense>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace posidonia
{
/** One point seen by both cameras of a rectified pair.
 * Its noise is independent in (u, v) and in the disparity d = u_left - u_right, not in u_left and u_right:
 * the detector places the key point, then a patch alignment finds how far the right image shows the same
 * place. */
struct TStereoPoint
{
	Eigen::Vector3d uvr;		 ///< (u_left, v, u_right) [px]
	Eigen::Vector3d point;		 ///< Left-camera coordinates [m]
	Eigen::Matrix3f covariance;	 ///< Of `point` [m^2]
	float sigma_uv;				 ///< Noise of u_left and of v [px], each
	float sigma_d;				 ///< Noise of the disparity [px]
	float octave;				 ///< log2 of the key point's size over the detector's smallest

	/** (u_left, v, disparity) [px]. */
	Eigen::Vector3d uvd() const { return {uvr.x(), uvr.y(), uvr.x() - uvr.z()}; }
};

/** What is kept of a stereo pair: the points with a stereo partner and their descriptors. */
struct TKeyFrame
{
	std::vector<TStereoPoint> points;
	cv::Mat descriptors;  ///< CV_8U, a row a point: SIFT 128 (integers 0-255), ORB 32, AKAZE 61 bytes
	bool binary{false};	  ///< Descriptors compared by Hamming (true) or Euclidean distance
	int detected_left{0}, detected_right{0};  ///< Key points before stereo matching

	size_t size() const { return points.size(); }
	/** Memory taken by points and descriptors [bytes]. */
	size_t bytes() const;
};

/** A point triangulated with its covariance. @param uvd (u_left, v, disparity) [px], disparity > 0 */
TStereoPoint makeStereoPoint(
	const TStereoCamera& camera, const Eigen::Vector3d& uvd, double sigma_uv, double sigma_d, double octave);
}  // namespace posidonia
