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

void CFlatSeaFloor::gradientsAt(
	const std::vector<float>&, const std::vector<float>&, TGradients& gradients) const
{
	std::fill(gradients.per_north.begin(), gradients.per_north.end(), 0.0f);
	std::fill(gradients.per_east.begin(), gradients.per_east.end(), 0.0f);
}

cv::Mat1f CSeaFloor::rangesAlong(const TViewRays& rays, const Eigen::Isometry3d& T_map_camera) const
{
	cv::Mat1f ranges(rays.height, rays.width);
	float* out = ranges.ptr<float>();
	for (size_t i = 0; i < rays.size(); i++)
		out[i] = static_cast<float>(rangeAlong(
			T_map_camera * rays.origin[i].cast<double>(),
			T_map_camera.linear() * rays.direction[i].cast<double>()));
	return ranges;
}
}  // namespace posidonia
