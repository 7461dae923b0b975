#pragma once

#include <posidonia/base/options.h>

#include <cmath>
#include <string>

namespace posidonia
{
/** Section [ClosedLoop]: a mission under its own control. */
struct TClosedLoopOptions
{
	std::string mission;
	std::string pose_source{"slam"};
	double control_rate{10}, endurance{8};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.text("mission", mission, "Mission file, from the ini's folder or absolute");
		v.choice(
			"pose_source", pose_source, {"odometry", "slam", "truth"},
			"What the controllers steer by: the odometry (after the corruptor), SLAM, or the true pose");
		v.number("control_rate", control_rate, between(1, 100), "Steps of the autopilot [Hz] (COLA2: 10)");
		v.number(
			"endurance", endurance, above(0),
			"The battery is empty after this time [h] (SPARUS II: 8 to 10)");
	}
};

/** Section [Slam], beside the engine's: the loop's own key. */
struct TSlamLatencyOptions
{
	double latency{0.5};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"latency", latency, atLeast(0),
			"Closed loop: from a stereo pair to the correction that it causes [s]");
	}
};

/** Section [ForcedCorrection]: a jump of the map, to see what the controllers make of it. */
struct TForcedCorrectionOptions
{
	double time{0}, distance{1}, direction{0}, turn{5 * M_PI / 180};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("time", time, atLeast(0), "When, from the start [s]; 0: never");
		v.number("distance", distance, atLeast(0), "The map's pose of the vehicle jumps by this [m]");
		v.degrees("direction", direction, between(-180, 180), "... this way, clockwise from north [deg]");
		v.degrees("turn", turn, between(-180, 180), "... and turns by this about the vehicle [deg]");
	}
};
}  // namespace posidonia
