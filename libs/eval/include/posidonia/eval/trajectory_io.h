#pragma once

#include <posidonia/geometry/trajectory.h>

#include <string>

/** Trajectories as text. Poses are T_world_body of whatever pair of frames the file's owner says.
 *
 * | format | a line | comments |
 * | --- | --- | --- |
 * | TUM | `t x y z qx qy qz qw`, t in seconds | lines that start with # |
 * | KITTI | the 12 numbers of the 3x4 matrix [R t], row by row | no time: a stamp file beside it, or the
 * line's index | | EuRoC | `t,p_x,p_y,p_z,q_w,q_x,q_y,q_z[,...]`, t in whole nanoseconds | lines that start
 * with # |
 *
 * Every reader throws CError "<file>:<line>: ..." for a line of the wrong shape, a number that is none, a
 * rotation that is none, or a stamp smaller than the one before; CError "<file>: ..." for a file that is
 * absent or has no pose. A stamp is a double: at today's UTC it is good to 0.24 microseconds, which EuRoC's
 * nanoseconds lose on the way in. */
namespace posidonia
{
/** Seconds and metres with 9 decimals, quaternion with 12 and w >= 0. Throws CError for a pose that is not
 * finite. */
std::string tumText(const TTrajectory& trajectory);
std::string kittiText(const TTrajectory& trajectory);
std::string eurocText(const TTrajectory& trajectory);

void writeTum(const std::string& path, const TTrajectory& trajectory);
void writeKitti(const std::string& path, const TTrajectory& trajectory);
void writeEuroc(const std::string& path, const TTrajectory& trajectory);

TTrajectory readTum(const std::string& path);
/** The pose's index is its stamp. */
TTrajectory readKitti(const std::string& path);
/** `stamps_path`: a time in seconds a line, as many as poses. */
TTrajectory readKitti(const std::string& path, const std::string& stamps_path);
TTrajectory readEuroc(const std::string& path);

/** Any of the three, told apart by the first line with data: commas, 8 columns or 12. */
TTrajectory readTrajectory(const std::string& path);
}  // namespace posidonia
