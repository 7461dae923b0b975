#include <posidonia/eval/footprint.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace posidonia
{
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
double cross(const Vector2d& a, const Vector2d& b)
{
	return a.x() * b.y() - a.y() * b.x();
}

/** The part of `polygon` on the left of the line a -> b. */
TPolygon clipped(const TPolygon& polygon, const Vector2d& a, const Vector2d& b)
{
	TPolygon kept;
	for (size_t i = 0; i < polygon.size(); i++) {
		const Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
		const double dp = cross(b - a, p - a), dq = cross(b - a, q - a);
		if (dp >= 0) kept.push_back(p);
		if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) kept.push_back(p + dp / (dp - dq) * (q - p));
	}
	return kept;
}
}  // namespace

double area(const TPolygon& polygon)
{
	double twice = 0;
	for (size_t i = 0; i < polygon.size(); i++)
		twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
	return twice / 2;
}

TPolygon intersection(const TPolygon& a, const TPolygon& b)
{
	if (a.size() < 3 || b.size() < 3) return {};
	TPolygon common = a;
	for (size_t i = 0; i < b.size(); i++)
		common = clipped(common, b[i], b[(i + 1) % b.size()]);
	return common.size() < 3 ? TPolygon{} : common;
}

TPolygon footprint(const TFootprintCamera& camera, const Eigen::Isometry3d& T_map_body)
{
	const TStereoCamera& c = camera.camera;
	const Eigen::Isometry3d T_map_cam = T_map_body * camera.T_body_cam;
	const double height = camera.floor_depth - T_map_cam.translation().z();
	const double right = c.width - 0.5, bottom = c.height - 0.5;
	const std::array<Vector2d, 4> corners{{{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}};
	TPolygon polygon;
	for (const auto& corner : corners) {
		const Vector3d ray_cam((corner.x() - c.cx) / c.fx, (corner.y() - c.cy) / c.fy, 1);
		const Vector3d ray = T_map_cam.linear() * ray_cam;
		if (height <= 0 || ray.z() <= 1e-6) return {};
		polygon.push_back((T_map_cam.translation() + height / ray.z() * ray).head<2>());
	}
	// The world's (x, y) seen along +z, as the camera sees it, keeps the sense of rotation of (u, v).
	if (area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
	return polygon;
}

double overlap(const TPolygon& a, const TPolygon& b)
{
	const double smaller = std::min(area(a), area(b));
	return smaller > 0 ? std::clamp(area(intersection(a, b)) / smaller, 0.0, 1.0) : 0.0;
}
}  // namespace posidonia
