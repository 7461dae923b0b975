#include "floor_view.h"

#include <cmath>

#include "row_kernels.h"

namespace posidonia
{
using Eigen::Vector3d;
using Eigen::Vector3f;

void CPlaneView::intersectRow(int v, TPixelRow& row) const
{
	const Vector3d origin = m_R * Vector3d(-m_camera.cx / m_camera.fx, (v - m_camera.cy) / m_camera.fy, 1);
	const Vector3d step = m_R.col(0) / m_camera.fx;
	const TPlaneRow plane{
		{origin.x(), origin.y(), origin.z()},
		{step.x(), step.y(), step.z()},
		m_foot.x() + 0.5,
		m_foot.y() + 0.5,
		m_height / m_resolution,
		m_height,
		m_ray_length.data() + static_cast<size_t>(v) * static_cast<size_t>(m_camera.width)};
	meetPlane(plane, row.col.data(), row.row.data(), row.range.data(), row.range.size());
	row.way = row.range;
	std::fill(row.irradiance.begin(), row.irradiance.end(), 1.0f);
	std::fill(row.level.begin(), row.level.end(), m_levels.fine);
	std::fill(row.share.begin(), row.share.end(), m_levels.share);
}

CTracedView::CTracedView(const TWorld& world, const CFloorRenderer::TMoment& moment)
	: m_world(world),
	  m_R(moment.T_map_camera.linear().cast<float>()),
	  m_centre(moment.T_map_camera.translation()),
	  m_lamp((moment.lamp - m_centre).cast<float>()),
	  m_ranges(world.floor.rangesAlong(world.rays, moment.T_map_camera)),
	  m_points(static_cast<size_t>(world.rays.width))
{
}

void CTracedView::intersectRow(int v, TPixelRow& row) const
{
	locate(v, row, m_points);
	m_world.floor.gradientsAt(m_points.north, m_points.east, m_points.slope);
	row.way = row.range;
	if (m_world.lamp.on())
		lightByLamp(m_points, row);
	else
		lightByDay(m_points, row);
}

void CTracedView::locate(int v, TPixelRow& row, TPoints& points) const
{
	constexpr float farthest = 1000;  // [m]: what meets nothing, or lies past every horizon
	const float none[] = {0, 0, 0};
	const TViewRays& rays = m_world.rays;
	const size_t width = static_cast<size_t>(rays.width), first = static_cast<size_t>(v) * width;
	std::copy_n(m_ranges.ptr<float>(v), width, row.range.data());
	pointsAlong(
		rowOf(rays.origin, first), rowOf(rays.direction, first), farthest, row.range.data(),
		rowOf(points.camera), width);
	turnRow(m_R.data(), none, rowOf(points.camera, 0), rowOf(points.map), width);

	const float last = static_cast<float>(m_world.levels.size() - 1);
	const Eigen::Vector3f centre = m_centre.cast<float>();
	const Eigen::Vector2d foot = m_world.texture.pixelAt(m_centre.head<2>()) + Eigen::Vector2d(0.5, 0.5);
	const double per_metre = 1 / m_world.texture.resolution();
	for (size_t u = 0; u < width; u++) {
		const float level = points.camera.z[u] / TMipLevels::kStep + 0.5f;
		const TMipLevels& levels = m_world.levels[static_cast<size_t>(std::min(std::max(level, 0.0f), last))];
		row.level[u] = levels.fine, row.share[u] = levels.share;
		points.north[u] = centre.x() + points.map.x[u];
		points.east[u] = centre.y() + points.map.y[u];
		row.col[u] = foot.x() + static_cast<double>(points.map.y[u]) * per_metre;
		row.row[u] = foot.y() - static_cast<double>(points.map.x[u]) * per_metre;
	}
}

/** Lambert's law, light from straight above. */
void CTracedView::lightByDay(const TPoints& points, TPixelRow& row) const
{
	const float *gx = points.slope.per_north.data(), *gy = points.slope.per_east.data();
	float* out = row.irradiance.data();
	const size_t width = row.irradiance.size();
	for (size_t u = 0; u < width; u++)
		out[u] = 1 / std::sqrt(1 + gx[u] * gx[u] + gy[u] * gy[u]);
}

/** Lambert's law, light that falls off with the square of the distance from the lamp. */
void CTracedView::lightByLamp(const TPoints& points, TPixelRow& row) const
{
	const float reference = static_cast<float>(m_world.lamp.reference);
	for (size_t u = 0; u < row.irradiance.size(); u++) {
		const Vector3f up(points.slope.per_north[u], points.slope.per_east[u], -1);	 // not of unit length
		const Vector3f to_lamp = m_lamp - points.map[u];
		const float distance = to_lamp.norm();
		const float cosine = std::max(up.dot(to_lamp) / (up.norm() * distance), 0.0f);
		row.irradiance[u] = cosine * reference * reference / (distance * distance);
		row.way[u] += distance;
	}
}
}  // namespace posidonia
