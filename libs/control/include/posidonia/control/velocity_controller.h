#pragma once

#include <posidonia/base/options.h>
#include <posidonia/control/commands.h>
#include <posidonia/control/pid.h>

#include <array>
#include <vector>

namespace posidonia
{
/** Section [VelocityControl]: from velocities to forces, an axis each of surge, heave and yaw. */
struct TVelocityControlOptions
{
	std::vector<double> gain{40, 110, 28};
	std::vector<double> integral_time{4, 6, 5};
	std::vector<double> derivative_time{0, 0, 0};
	std::vector<double> integral_limit{15, 12, 3};
	std::vector<double> inertia{54.1, 121.2, 26.7};
	std::vector<double> linear_drag{8, 30, 5};
	std::vector<double> quadratic_drag{36.4, 89, 15};
	double buoyancy{0.98};
	std::vector<double> thruster_lag{0.8, 0.4, 0.8};
	double lead_filter{0.2};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.numbers("gain", gain, 3, atLeast(0), "Surge heave yaw: force per error [N s/m, N s/m, N m s/rad]");
		v.numbers("integral_time", integral_time, 3, above(0), "Surge heave yaw: integral time [s]");
		v.numbers("derivative_time", derivative_time, 3, atLeast(0), "Surge heave yaw: on the feedback [s]");
		v.numbers("integral_limit", integral_limit, 3, atLeast(0), "Bound of the integrals [N, N, N m]");
		v.numbers(
			"inertia", inertia, 3, atLeast(0),
			"Mass with added mass, feed-forward [kg, kg, kg m^2] (Toulon)");
		v.numbers("linear_drag", linear_drag, 3, atLeast(0), "Feed-forward [N s/m, N s/m, N m s]");
		v.numbers(
			"quadratic_drag", quadratic_drag, 3, atLeast(0),
			"Feed-forward [N s2/m2, N s2/m2, N m s2] (Toulon)");
		v.numbers(
			"thruster_lag", thruster_lag, 3, atLeast(0),
			"Surge heave yaw: lag of the thrusters that the fed-forward force makes up for [s] (Toulon)");
		v.number("lead_filter", lead_filter, above(0), "... through a filter of this time constant [s]");
		v.number("buoyancy", buoyancy, anyNumber(), "Upward excess of buoyancy over weight [N] (0.1 kg)");
	}
};

/** From velocities to forces: a PID an axis, with the force that the wanted motion takes fed forward:
 * m dv/dt + d_lin v + d_quad v |v|, v through the water, led by (1 + lag s) / (1 + filter s) for the
 * thrusters' lag. */
class CVelocityController
{
   public:
	explicit CVelocityController(const TVelocityControlOptions& options);

	/** `measured`: over ground. `acceleration`: of the command, per second. `through_water`: the command as
	 * the water sees it. `dt` since the last call [s]. */
	TWrench update(
		const TVelocityCommand& command, const TVelocityCommand& measured,
		const TVelocityCommand& acceleration, const TVelocityCommand& through_water, double dt);
	/** What the thrusters could give of the last wrench: stops the integrals of saturated axes. */
	void noteAchieved(const TWrench& achieved);
	void reset();

   private:
	/** Force that a motion takes, led by the thrusters' lag. */
	double feedForward(size_t axis, double acceleration, double velocity, double dt);

	TVelocityControlOptions m_options;
	CPid m_surge, m_heave, m_yaw;
	std::array<double, 3> m_filtered{0, 0, 0};	///< Fed-forward forces after the lead's filter
	TWrench m_wanted;
};
}  // namespace posidonia
