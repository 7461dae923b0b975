#pragma once

#include <posidonia/dataset/sensor_yaml.h>
#include <posidonia/geometry/stereo_camera.h>

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace posidonia
{
/** One camera of a set: pinhole with radial-tangential distortion. */
struct TRawCamera
{
	int width{0}, height{0};								///< [px]
	double fu{0}, fv{0}, cu{0}, cv{0};						///< [px]
	std::vector<double> distortion{0, 0, 0, 0};				///< k1 k2 p1 p2 [k3]
	Eigen::Isometry3d T_BS{Eigen::Isometry3d::Identity()};	///< Camera to the set's body
	double rate{0};											///< [Hz], > 0

	/** Reads camN/sensor.yaml; throws CError naming file and line. `warnings` gets keys without effect. */
	static TRawCamera fromYaml(const std::string& path, std::vector<std::string>& warnings);
};

/** Rotates and undistorts the pictures of a stereo rig so that rows are aligned (Bouguet's method, OpenCV's
 * stereoRectify with alpha 0: only valid pixels). A rig whose rows are aligned already is left as it is. */
class CStereoRectifier
{
   public:
	/** Throws CError naming `where` when the two cameras don't fit: sizes, baseline not along +x of cam0. */
	CStereoRectifier(const TRawCamera& left, const TRawCamera& right, bool cubic, const std::string& where);

	/** Grey picture of a side, rectified. Thread-safe. */
	cv::Mat rectified(const cv::Mat& grey, bool right_side) const;
	/** No distortion, parallel axes, same intrinsics: pictures pass unchanged. */
	bool isIdentity() const { return m_identity; }
	/** The rectified rig. */
	const TStereoCamera& camera() const { return m_camera; }
	/** R_raw_rectified of the left camera: T_BS(rectified) = T_BS(cam0) * this. */
	const Eigen::Matrix3d& rotation() const { return m_rotation; }

   private:
	void compute(const TRawCamera& left, const TRawCamera& right, const std::string& where);

	bool m_identity{false};
	int m_interpolation;
	TStereoCamera m_camera;
	Eigen::Matrix3d m_rotation{Eigen::Matrix3d::Identity()};
	cv::Mat m_map_x[2], m_map_y[2];
};
}  // namespace posidonia
