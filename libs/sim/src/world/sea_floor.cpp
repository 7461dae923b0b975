#include <posidonia/sim/sea_floor.h>

#include <limits>

namespace posidonia
{
using Eigen::Vector3d;

double CFlatSeaFloor::rangeAlong(const Vector3d& origin, const Vector3d& direction) const
{
	if (direction.z() <= 0) return std::numeric_limits<double>::infinity();
	return (m_depth - origin.z()) / direction.z();
}

cv::Mat1f CSeaFloor::rangesAlong(const TViewRays& rays, const Eigen::Isometry3d& T_map_camera) const
{
	cv::Mat1f ranges(rays.height, rays.width);
	float* out = ranges.ptr<float>();
	for (size_t i = 0; i < rays.size(); i++)
		out[i] = static_cast<float>(
			rangeAlong(T_map_camera * rays.originOf(i), T_map_camera.linear() * rays.directionOf(i)));
	return ranges;
}
}  // namespace posidonia
