#include <posidonia/sim/relief_sea_floor.h>

#include "height_surface.h"
#include "picture_tracer.h"
#include "ray_tracer.h"

namespace posidonia
{
using Eigen::Vector2d;
using Eigen::Vector3d;

struct CReliefSeaFloor::TShape
{
	explicit TShape(const TDepthGrid& grid) : surface(grid), tracer(grid) {}
	CHeightSurface surface;
	CRayTracer tracer;
};

CReliefSeaFloor::CReliefSeaFloor(const TDepthGrid& grid) : m_shape(std::make_unique<TShape>(grid)) {}
CReliefSeaFloor::~CReliefSeaFloor() = default;

double CReliefSeaFloor::depthAt(const Vector2d& north_east) const
{
	const Eigen::Vector2f p = north_east.cast<float>();
	return static_cast<double>(m_shape->surface.at(p.x(), p.y()).depth);
}

Eigen::Vector2f CReliefSeaFloor::gradientAt(const Vector2d& north_east) const
{
	const Eigen::Vector2f p = north_east.cast<float>();
	return m_shape->surface.smoothGradient(p.x(), p.y());
}

double CReliefSeaFloor::rangeAlong(const Vector3d& origin, const Vector3d& direction) const
{
	CRayTracer::TPacket ray;
	ray.add(origin.cast<float>(), direction.cast<float>());
	m_shape->tracer.trace(ray);
	return static_cast<double>(ray.range[0]);
}

cv::Mat1f CReliefSeaFloor::rangesAlong(const TViewRays& rays, const Eigen::Isometry3d& T_map_camera) const
{
	return CPictureTracer(m_shape->surface, m_shape->tracer, rays, T_map_camera).ranges();
}
}  // namespace posidonia
