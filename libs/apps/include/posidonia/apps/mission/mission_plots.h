#pragma once

#include <posidonia/apps/mission/closed_loop.h>

#include <string>

namespace posidonia
{
/** Over time, as SVG: the 3D error of the pose that the controllers used, the true cross-track error on the
 * legs. */
std::string plotMissionErrors(const std::vector<TControlStep>& steps);
/** Over time, as SVG: what was commanded before the limiters: yaw rate and surge. */
std::string plotCommands(const std::vector<TControlStep>& steps);

/** True horizontal distance from the line of the leg, positive to starboard [m]; NaN while no leg is run
 * along. */
double trueCrossTrack(const TControlStep& step);
/** 3D distance between the pose that the controllers used and the true one [m]; NaN while there is none. */
double controlError(const TControlStep& step);
}  // namespace posidonia
