#include "floor_view.h"

#include <cmath>

namespace posidonia
{
using Eigen::Vector3d;
using Eigen::Vector3f;

void CPlaneView::intersectRow(int v, TPixelRow& row) const
{
	const Vector3d origin = m_R * Vector3d(-m_camera.cx / m_camera.fx, (v - m_camera.cy) / m_camera.fy, 1);
	const Vector3d step = m_R.col(0) / m_camera.fx;
	const float* length = m_ray_length.data() + static_cast<size_t>(v) * static_cast<size_t>(m_camera.width);
	const double pixels = m_height / m_resolution;
	for (int u = 0; u < m_camera.width; u++) {
		const double north = origin.x() + u * step.x(), east = origin.y() + u * step.y();
		const double down = origin.z() + u * step.z();
		const double per_depth = 1 / std::max(down, 1e-3);	// over the horizon: far away
		row.range[u] = static_cast<float>(m_height * per_depth) * length[u];
		row.col[u] = m_foot.x() + 0.5 + east * per_depth * pixels;
		row.row[u] = m_foot.y() + 0.5 - north * per_depth * pixels;
	}
	row.way = row.range;
	std::fill(row.irradiance.begin(), row.irradiance.end(), 1.0f);
	std::fill(row.levels.begin(), row.levels.end(), m_levels);
}

CTracedView::CTracedView(const TWorld& world, const CFloorRenderer::TMoment& moment)
	: m_world(world),
	  m_R(moment.T_map_camera.linear().cast<float>()),
	  m_centre(moment.T_map_camera.translation()),
	  m_lamp((moment.lamp - m_centre).cast<float>()),
	  m_ranges(world.floor.rangesAlong(world.rays, moment.T_map_camera))
{
}

void CTracedView::intersectRow(int v, TPixelRow& row) const
{
	constexpr float farthest = 1000;  // [m]: what meets nothing, or lies past every horizon
	const TViewRays& rays = m_world.rays;
	const double per_metre = 1 / m_world.texture.resolution();
	const Eigen::Vector2d foot = m_world.texture.pixelAt(m_centre.head<2>());
	for (int u = 0; u < rays.width; u++) {
		const size_t i = static_cast<size_t>(v) * static_cast<size_t>(rays.width) + static_cast<size_t>(u);
		const float range = std::clamp(m_ranges.ptr<float>()[i], 0.0f, farthest);
		const Vector3f p(
			rays.origin_x[i] + range * rays.x[i], rays.origin_y[i] + range * rays.y[i],
			rays.origin_z[i] + range * rays.z[i]);
		const Vector3f q = m_R * p;
		row.range[u] = range;
		row.col[u] = foot.x() + 0.5 + static_cast<double>(q.y()) * per_metre;
		row.row[u] = foot.y() + 0.5 - static_cast<double>(q.x()) * per_metre;
		const float last = static_cast<float>(m_world.levels.size() - 1);
		row.levels[u] = m_world.levels[static_cast<size_t>(
			std::min(std::max(p.z() / TMipLevels::kStep + 0.5f, 0.0f), last))];
		illuminate(
			{q, m_world.floor.gradientAt(m_centre.head<2>() + q.head<2>().cast<double>())},
			static_cast<size_t>(u), row);
	}
}

/** Lambert's law: by day the light falls straight down; a lamp's falls off with the square of the distance.
 */
void CTracedView::illuminate(const TPoint& point, size_t u, TPixelRow& row) const
{
	const Vector3f up(point.gradient.x(), point.gradient.y(), -1);	// normal of the floor, not of unit length
	row.way[u] = row.range[u];
	if (!m_world.lamp.on()) {
		row.irradiance[u] = 1 / up.norm();
		return;
	}
	const Vector3f to_lamp = m_lamp - point.from_camera;
	const float distance = to_lamp.norm(), reference = static_cast<float>(m_world.lamp.reference);
	const float cosine = std::max(up.dot(to_lamp) / (up.norm() * distance), 0.0f);
	row.irradiance[u] = cosine * reference * reference / (distance * distance);
	row.way[u] += distance;
}
}  // namespace posidonia
