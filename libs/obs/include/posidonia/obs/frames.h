#pragma once

#include <posidonia/geometry/stereo_camera.h>

// clang-format off
/** Every frame of Posidonia, said once. `T_a_b` maps coordinates of b to a.
 *
 * | frame  | axes                     | origin                                                                 |
 * | ------ | ------------------------ | ---------------------------------------------------------------------- |
 * | map    | north, east, down        | the datum of the ini ([World] latitude, longitude), at the sea surface |
 * | odom   | north, east, down        | the odometry's world: starts equal to map and drifts away              |
 * | body   | forward, starboard, down | the vehicle's centre of gravity                                        |
 * | camera | right, down, forward     | optical centre of the LEFT camera (OpenCV's axes)                      |
 * | sensor | the instrument's own     | T_body_sensor is its observation's sensorPose                          |
 *
 * The down-looking rig (`downLookingCamera()`) has camera x = starboard, y = aft, z = down: the top of the image is
 * the bow, the baseline runs along starboard. Gravity in map is (0, 0, +g); an accelerometer at rest reads (0, 0, -g). */
// clang-format on
namespace posidonia
{
inline constexpr double kGravity = 9.80665;	 ///< [m/s^2], standard gravity
}  // namespace posidonia
