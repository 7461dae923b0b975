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
	// A ray straight down: one step meets the triangle below.
	const float x = static_cast<float>(north_east.x()), y = static_cast<float>(north_east.y());
	const float surface = 0, level = 0, down = 1;
	float range = 0, miss, rate;
	stepToSurface(
		m_shape->surface.depth(), {&x, &y, &surface}, {&level, &level, &down}, &range, &miss, &rate, 1);
	return static_cast<double>(range);
}

void CReliefSeaFloor::gradientsAt(
	const std::vector<float>& north, const std::vector<float>& east, TGradients& gradients) const
{
	valuesAt(
		m_shape->surface.perNorth(), north.data(), east.data(), gradients.per_north.data(), north.size());
	valuesAt(m_shape->surface.perEast(), north.data(), east.data(), gradients.per_east.data(), north.size());
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
