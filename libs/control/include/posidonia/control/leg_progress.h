#pragma once

#include <Eigen/Dense>

namespace posidonia
{
/** What a leg does now. */
enum class ELegPhase
{
	NONE,	   ///< The step is no leg
	TURN,	   ///< Turns on the spot towards the line
	RUN,	   ///< Along the line
	APPROACH,  ///< The end line was crossed outside the tolerance: straight to the point
};

/** Where the vehicle is on the present leg. */
struct TLegProgress
{
	ELegPhase phase{ELegPhase::NONE};
	Eigen::Vector2d start{0, 0}, end{0, 0};	 ///< North east [m]
	double along{0};						 ///< From the start [m]
	double cross{0};						 ///< Cross-track error, positive to starboard of the line [m]
};
}  // namespace posidonia
