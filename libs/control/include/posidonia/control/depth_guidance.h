#pragma once

#include <posidonia/control/control_state.h>
#include <posidonia/control/guidance_options.h>
#include <posidonia/control/mission.h>

namespace posidonia
{
/** Depth set-point of a step. In altitude mode z = depth + altitude - wanted, at least 0; an altitude that is
 * lost is extrapolated by the change of depth for a while, then taken as 0.5 m, so that the vehicle climbs
 * (COLA2's rule). */
class CDepthGuidance
{
   public:
	explicit CDepthGuidance(const TGuidanceOptions& options) : m_options(options) {}

	/** [m], down. */
	double target(const TStep& step, const TControlState& navigation);

   private:
	/** Altitude now: measured, extrapolated or supposed [m]. */
	double altitude(const TControlState& navigation);

	TGuidanceOptions m_options;
	double m_stamp{-1e9};			   ///< Of the last altitude [s]
	double m_altitude{0}, m_depth{0};  ///< Then [m]
};
}  // namespace posidonia
