#pragma once

#include <posidonia/control/guidance_options.h>

namespace posidonia
{
/** Integral line of sight for straight lines (Borhaug, Pavlov, Pettersen: Integral LOS control for path
 * following of underactuated marine surface vessels in the presence of constant ocean currents, CDC 2008, eq.
 * 11-12; Caharija et al., IEEE TCST 2016):
 *
 *   course = chi - atan((e + sigma y) / Delta),   dy/dt = Delta e / ((e + sigma y)^2 + Delta^2)
 *
 * e: cross-track error, positive to starboard. The rate of y falls with the error: the law unwinds by itself;
 * sigma y is bounded besides. */
class CLineOfSight
{
   public:
	explicit CLineOfSight(const TGuidanceOptions& options) : m_options(options) {}

	/** Course [rad] off the line's own for a cross-track error [m], after `dt` [s]. */
	double update(double cross, double dt);
	/** The same with the integral as it is. */
	double course(double cross) const;
	/** Rate of course() [rad/s] while the error changes at `cross_rate` [m/s]. */
	double courseRate(double cross, double cross_rate) const;
	void reset() { m_integral = 0; }
	/** sigma y [m]. */
	double integral() const { return m_integral; }

   private:
	TGuidanceOptions m_options;
	double m_integral{0};
};
}  // namespace posidonia
