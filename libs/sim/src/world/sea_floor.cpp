#include <posidonia/sim/sea_floor.h>

#include <limits>

namespace posidonia
{
double CFlatSeaFloor::rangeAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const
{
	if (direction.z() <= 0) return std::numeric_limits<double>::infinity();
	return (m_depth - origin.z()) / direction.z();
}
}  // namespace posidonia
