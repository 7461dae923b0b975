#pragma once

#include <posidonia/apps/mission/closed_loop.h>
#include <posidonia/eval/metrics.h>

#include <string>
#include <vector>

namespace posidonia
{
/** Rows "mission.*" of what a closed loop did, by the truth. (The error of the pose that the controllers used
 * is "control.ate.*", as for any trajectory.)
 *
 * - cross_track: true horizontal distance from the line of the leg, while it is run along (not while turning
 *   on the spot);
 * - end_error: true horizontal distance from the mission's last point while station is kept there;
 * - yaw_rate_step, surge_step: change of the command, before the limiters, from one step to the next;
 *   yaw_rate_range, surge_range: its largest minus its smallest value in the 4 s round a step. Of each the
 * 99th percentile and the largest. */
TMetrics missionMetrics(const std::vector<TControlStep>& steps, const TMission& mission);

/** How the controllers' pose took a jump of the map: rows "jump.*". Empty without one.
 * @param time of the jump [s] */
TMetrics jumpMetrics(const std::vector<TControlStep>& steps, double time);

/** control.csv: a row each step. */
std::string controlCsv(const std::vector<TControlStep>& steps);
/** events.csv: t,kind,text; when faults begin and end stands there, too. */
std::string eventsCsv(const std::vector<TControlStep>& steps, double start_time);
/** A few lines for the terminal. */
std::string missionSummary(const TMetrics& rows);
}  // namespace posidonia
