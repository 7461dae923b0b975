#pragma once

#include <posidonia/geometry/stereo_camera.h>

#include <vector>

namespace posidonia
{
/** Convex polygon in the plane, corners counter-clockwise; fewer than 3 corners: empty. */
using TPolygon = std::vector<Eigen::Vector2d>;

/** Signed area [square of the corners' unit], positive counter-clockwise. */
double area(const TPolygon& polygon);

/** Common part of two convex polygons (Sutherland and Hodgman 1974). */
TPolygon intersection(const TPolygon& a, const TPolygon& b);

/** A camera on a body over a flat floor. */
struct TFootprintCamera
{
	TStereoCamera camera;								///< the left image counts
	Eigen::Isometry3d T_body_cam{downLookingCamera()};	///< at the body's origin unless told
	double floor_depth{6.0};							///< z of the floor in the north-east-down world [m]
};

/** What the left image covers of the floor, in the world's (x, y) [m]: corners of the image (at half a pixel
 * outside the outermost pixel centres) projected on z = floor_depth. Empty when a corner's ray does not meet
 * the floor. */
TPolygon footprint(const TFootprintCamera& camera, const Eigen::Isometry3d& T_map_body);

/** Area in common over the smaller one's area, in [0, 1]; 0 when either is empty. */
double overlap(const TPolygon& a, const TPolygon& b);
}  // namespace posidonia
