#pragma once

#include <posidonia/base/options.h>

#include <Eigen/Dense>

namespace posidonia
{
/** Section [CurrentObserver]. */
struct TCurrentObserverOptions
{
	bool enabled{true};
	double sway_time{4}, surge_time{10}, trusted_speed{0.05}, max_current{0.5}, dead_zone{0.03};
	double surge_mass{54.1}, surge_linear_drag{8}, surge_quadratic_drag{36.4};
	double sway_mass{122.4}, sway_linear_drag{30}, sway_quadratic_drag{96};
	double thruster_lag{0.8};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.flag(
			"enabled", enabled,
			"The observed current gives the crab angle at once; off: the integral of the line of sight "
			"alone");
		v.number("sway_time", sway_time, above(0), "Time constant of the current's athwart part [s]");
		v.number(
			"surge_time", surge_time, above(0), "... and of its fore-and-aft part at rest in the water [s]");
		v.number(
			"trusted_speed", trusted_speed, above(0),
			"The fore-and-aft part learns by 1 / (1 + (u / this)^2): an error of the drag grows with u "
			"[m/s]");
		v.number("max_current", max_current, above(0), "Bound of the estimate, each axis [m/s]");
		v.number("dead_zone", dead_zone, atLeast(0), "A weaker current counts as none [m/s]");
		v.number("surge_mass", surge_mass, above(0), "With added mass [kg] (Toulon)");
		v.number("surge_linear_drag", surge_linear_drag, atLeast(0), "[N s/m] (assumption)");
		v.number("surge_quadratic_drag", surge_quadratic_drag, atLeast(0), "[N s2/m2] (Toulon)");
		v.number("sway_mass", sway_mass, above(0), "With added mass [kg] (Toulon)");
		v.number("sway_linear_drag", sway_linear_drag, atLeast(0), "[N s/m] (assumption)");
		v.number("sway_quadratic_drag", sway_quadratic_drag, atLeast(0), "[N s2/m2] (Toulon)");
		v.number(
			"thruster_lag", thruster_lag, above(0), "Time constant of the surge thrusters [s] (Toulon: 0.8)");
	}
};

/** What the observer sees at a controller step. */
struct TCurrentObservation
{
	double heading{0}, yaw_rate{0};	 ///< [rad], [rad/s]
	Eigen::Vector2d velocity{0, 0};	 ///< Surge and sway over ground [m/s]
	double surge_force{0};			 ///< Commanded to the thrusters [N]
};

/** The water's velocity, from the difference between the velocity over ground (DVL) and that through the
 * water, which a surge-sway model predicts. Sway tells most: nothing drives it but the current and turns. */
class CCurrentObserver
{
   public:
	explicit CCurrentObserver(const TCurrentObserverOptions& options) : m_options(options) {}

	void update(const TCurrentObservation& seen, double dt);

	/** North east [m/s]; shrunk by the dead zone, zero when disabled. */
	Eigen::Vector2d current() const;

   private:
	Eigen::Vector2d modelAcceleration(double yaw_rate) const;

	TCurrentObserverOptions m_options;
	Eigen::Vector2d m_current{0, 0};		///< Map [m/s]
	Eigen::Vector2d m_through_water{0, 0};	///< Surge and sway of the model [m/s]
	double m_thrust{0};						///< After the lag [N]
};
}  // namespace posidonia
