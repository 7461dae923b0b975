#pragma once

#include <posidonia/base/options.h>
#include <posidonia/control/commands.h>

namespace posidonia
{
/** Section [Allocation]: SPARUS II's thrusters (design/vehicle.md 1.4; Toulon and Stonefish models). */
struct TAllocationOptions
{
	double arm{0.167};
	double surge_forward{71.5}, surge_reverse{30}, heave_forward{55}, heave_reverse{28.5};
	double dead_band{0.05};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("arm", arm, above(0), "Surge thrusters off the axis [m] (Stonefish: 0.167)");
		v.number("surge_forward", surge_forward, above(0), "Thrust at set-point 1, each [N] (Toulon: 71.5)");
		v.number("surge_reverse", surge_reverse, above(0), "Thrust at set-point -1, each [N] (Toulon: 30)");
		v.number(
			"heave_forward", heave_forward, above(0), "Thrust at set-point 1, downwards [N] (Toulon: 55)");
		v.number("heave_reverse", heave_reverse, above(0), "Thrust at set-point -1 [N] (Toulon: 28.5)");
		v.number("dead_band", dead_band, between(0, 0.9), "Smaller set-points give no thrust (assumption)");
	}
};

/** Thrusts [N] or set-points in [-1, 1]. */
struct TThrusters
{
	double starboard{0}, port{0}, heave{0};
};

/** From a wanted wrench to thrusts. X = Ts + Tp, N = arm (Tp - Ts), Z = Th. */
class CThrusterAllocation
{
   public:
	explicit CThrusterAllocation(const TAllocationOptions& options) : m_options(options) {}

	/** Yaw first, then surge, then heave: each degree of freedom is scaled by the largest factor in [0, 1]
	 * that keeps every thruster in its range (COLA2's rule). */
	TThrusters thrusts(const TWrench& wanted) const;
	TWrench wrench(const TThrusters& thrusts) const;

	/** Set-points of thrusts, by the inverse of the thruster law T = T_max s |s|. */
	TThrusters setPoints(const TThrusters& thrusts) const;
	/** The thruster law; set-points inside the dead band give nothing. */
	TThrusters thrustsOf(const TThrusters& set_points) const;

   private:
	TAllocationOptions m_options;
};
}  // namespace posidonia
