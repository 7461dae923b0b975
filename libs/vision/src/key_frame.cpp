#include <posidonia/vision/key_frame.h>

namespace posidonia
{
size_t TKeyFrame::bytes() const
{
	return points.size() * sizeof(TStereoPoint) + descriptors.total() * descriptors.elemSize();
}

TStereoPoint makeStereoPoint(
	const TStereoCamera& camera, const Eigen::Vector3d& uvd, double sigma_uv, double sigma_d, double octave)
{
	TStereoPoint p;
	p.uvr << uvd.x(), uvd.y(), uvd.x() - uvd.z();
	p.point = camera.triangulate(p.uvr);
	// d(point)/d(u, v, d): z = f b / d, x = (u - cx) b / d, y = (v - cy) (fx / fy) b / d.
	const double z = p.point.z(), d = uvd.z();
	Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
	J(0, 0) = z / camera.fx;
	J(1, 1) = z / camera.fy;
	J.col(2) = -p.point / d;
	const Eigen::Vector3d variance(sigma_uv * sigma_uv, sigma_uv * sigma_uv, sigma_d * sigma_d);
	p.covariance = (J * variance.asDiagonal() * J.transpose()).cast<float>();
	p.sigma_uv = static_cast<float>(sigma_uv);
	p.sigma_d = static_cast<float>(sigma_d);
	p.octave = static_cast<float>(octave);
	return p;
}
}  // namespace posidonia
