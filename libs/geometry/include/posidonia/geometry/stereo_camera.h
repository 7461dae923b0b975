#pragma once

#include <Eigen/Dense>

namespace posidonia
{
/** R_body_camera of the down-looking rig in a forward-starboard-down body: camera x = starboard, y = aft,
 * z = down. */
inline Eigen::Matrix3d downLookingCamera()
{
	Eigen::Matrix3d R;
	R << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // columns: camera x, y, z in body axes
	return R;
}

/** A rectified stereo pair: same intrinsics on both sides, rows aligned.
 * Camera axes: x right, y down, z forward (OpenCV); the right camera is at (+baseline, 0, 0) of the left. */
struct TStereoCamera
{
	int width{640}, height{480};  ///< [px]
	double fx{283}, fy{283};	  ///< Focal lengths [px]
	double cx{319.5}, cy{239.5};  ///< Principal point [px], pixel centres at whole numbers
	double baseline{0.12};		  ///< [m], > 0

	/** (u_left, v, u_right) [px] of a point in left-camera coordinates [m], z > 0. */
	Eigen::Vector3d project(const Eigen::Vector3d& p) const
	{
		const double u = cx + fx * p.x() / p.z();
		return {u, cy + fy * p.y() / p.z(), u - fx * baseline / p.z()};
	}

	/** d(u_left, v, u_right)/dp, 3x3. */
	Eigen::Matrix3d projectJacobian(const Eigen::Vector3d& p) const
	{
		const double iz = 1 / p.z();
		Eigen::Matrix3d J;
		J << fx * iz, 0, -fx * p.x() * iz * iz, 0, fy * iz, -fy * p.y() * iz * iz, fx * iz, 0,
			-fx * (p.x() - baseline) * iz * iz;
		return J;
	}

	/** Point [m] in left-camera coordinates from (u_left, v, u_right) [px], u_left > u_right. */
	Eigen::Vector3d triangulate(const Eigen::Vector3d& uvr) const
	{
		const double z = fx * baseline / (uvr.x() - uvr.z());
		return {(uvr.x() - cx) * z / fx, (uvr.y() - cy) * z / fy, z};
	}
};
}  // namespace posidonia
