#pragma once

#include <posidonia/base/options.h>
#include <posidonia/geometry/se3.h>

namespace posidonia
{
/** Section [Thrusters]. Three numbers go starboard, port, heave; forward thrust is ahead, heave's is down. */
struct TThrusterOptions
{
	std::vector<double> starboard_position{-0.573, 0.167, 0}, port_position{-0.573, -0.167, 0};
	std::vector<double> heave_position{0, 0, 0.07};
	std::vector<double> max_forward{71.5, 71.5, 55}, max_reverse{30, 30, 28.5};
	std::vector<double> time_constant{0.8, 0.8, 0.4};
	double dead_band{0.05}, slew_rate{2};
	double zero_thrust_speed{0};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.numbers(
			"starboard_position", starboard_position, 3, between(-10, 10), "Body axes [m] (Stonefish's scn)");
		v.numbers("port_position", port_position, 3, between(-10, 10), "Body axes [m] (Stonefish's scn)");
		v.numbers("heave_position", heave_position, 3, between(-10, 10), "Body axes [m] (Stonefish's scn)");
		v.numbers("max_forward", max_forward, 3, above(0), "Thrust at the set-point 1 [N] (Toulon)");
		v.numbers("max_reverse", max_reverse, 3, above(0), "Thrust back at the set-point -1 [N] (Toulon)");
		v.numbers("time_constant", time_constant, 3, above(0), "First-order lag of the thrust [s] (Toulon)");
		v.number(
			"dead_band", dead_band, between(0, 0.9),
			"The propeller stands still at set-points smaller than this (an assumption)");
		v.number(
			"slew_rate", slew_rate, above(0),
			"The set-point in force moves by at most this [1/s] (an assumption)");
		v.number(
			"zero_thrust_speed", zero_thrust_speed, atLeast(0),
			"Speed through the water at which full set-point gives no thrust any more [m/s]; 0: no loss (the "
			"Toulon thrusts reach the published top speed without)");
	}
};

/** The three thrusters. The steady thrust of a set-point s is that of a propeller whose speed is s of its
 * greatest: T = T_max s |s|, none in the dead band, and with inflow u along the thrust
 * T = T_max |s| (s - u / u_0) (Fossen 2011, eq. 9.2: K_T falls linearly with the advance number). The thrust
 * follows by a first-order lag. All times [s] from the start. */
class CThrusters
{
   public:
	explicit CThrusters(const TThrusterOptions& options);

	/** From time t on; clamped to [-1, 1]. Throws CError when one is not a number. */
	void setSetPoints(double t, const Eigen::Vector3d& wanted);
	/** Factors on the thrust, 0 to 1. */
	void setEfficiency(const Eigen::Vector3d& factors) { m_efficiency = factors; }

	/** The set-points in force, after the rate limit; t not before that of setSetPoints(). */
	Eigen::Vector3d setPointsAt(double t) const;
	/** d thrust / dt [N/s], nu_r the body's velocity relative to the water. */
	Eigen::Vector3d thrustRate(double t, const Eigen::Vector3d& thrusts, const Vector6d& nu_r) const;
	/** Of thrusts [N], in body axes. */
	Vector6d wrench(const Eigen::Vector3d& thrusts) const { return m_configuration * thrusts; }

   private:
	double steadyThrust(int i, double set_point, double inflow) const;

	TThrusterOptions m_options;
	Eigen::Matrix<double, 6, 3> m_configuration;  ///< Wrench of one newton each
	Eigen::Vector3d m_efficiency{1, 1, 1};
	double m_since{0};	///< When m_wanted was set
	Eigen::Vector3d m_wanted{0, 0, 0}, m_before{0, 0, 0};
};
}  // namespace posidonia
