#pragma once

#include <posidonia/base/options.h>
#include <posidonia/control/commands.h>
#include <posidonia/control/control_state.h>
#include <posidonia/control/guidance_command.h>

namespace posidonia
{
/** Section [PoseControl]: from pose errors to velocities. */
struct TPoseControlOptions
{
	double heading_gain{0.45}, depth_gain{0.4};
	double max_yaw_rate{0.4}, max_yaw_acceleration{0.3};
	double max_surge{0.5}, max_surge_acceleration{0.2};
	double max_heave{0.3}, max_heave_acceleration{0.2};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("heading_gain", heading_gain, above(0), "Yaw rate per heading error [1/s]");
		v.number("depth_gain", depth_gain, above(0), "Vertical speed per depth error [1/s]");
		v.number("max_yaw_rate", max_yaw_rate, above(0), "Limit of the commanded yaw rate [rad/s]");
		v.number("max_yaw_acceleration", max_yaw_acceleration, above(0), "... and of its change [rad/s^2]");
		v.number("max_surge", max_surge, above(0), "Limit of the commanded surge [m/s]");
		v.number("max_surge_acceleration", max_surge_acceleration, above(0), "... and of its change [m/s^2]");
		v.number("max_heave", max_heave, above(0), "Limit of the commanded heave [m/s]");
		v.number("max_heave_acceleration", max_heave_acceleration, above(0), "... and of its change [m/s^2]");
	}
};

/** From pose errors to velocities: proportional, with the references' rates fed forward. The pitch is
 * passive, so part of the surge goes up or down and heave makes up for it: dz/dt = -u sin(pitch) + w
 * cos(pitch). */
class CPoseController
{
   public:
	explicit CPoseController(const TPoseControlOptions& options) : m_options(options) {}

	/** Before any limit. */
	TVelocityCommand command(const TGuidanceCommand& guidance, const TControlState& navigation) const;
	/** Saturated, and its change since the last call bounded; `dt` [s]. */
	TVelocityCommand limited(const TVelocityCommand& wanted, double dt);
	/** The next limited() starts from here. */
	void reset(const TVelocityCommand& now) { m_last = now; }

   private:
	TPoseControlOptions m_options;
	TVelocityCommand m_last;
};
}  // namespace posidonia
