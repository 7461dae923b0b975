#pragma once

#include <posidonia/sim/gauss_markov.h>
#include <posidonia/sim/hull.h>

namespace posidonia
{
/** Section [Current]. */
struct TCurrentOptions
{
	double speed{0}, direction{0}, shear{0};
	double gust_speed{0}, gust_time{30};
	double onset{0.5};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("speed", speed, atLeast(0), "At the surface [m/s]; 0: none");
		v.degrees(
			"direction", direction, between(-360, 360), "Whither it flows, from north towards east [deg]");
		v.number("shear", shear, anyNumber(), "Change of the speed with depth [m/s per m]");
		v.number(
			"gust_speed", gust_speed, atLeast(0), "Sigma of the gusts, north and east each [m/s]; 0: none");
		v.number("gust_time", gust_time, above(0), "Their correlation time [s]");
		v.number(
			"onset", onset, above(0),
			"A current added while under way (a fault's) comes and goes with this time constant [s]");
	}
};

/** The water's motion: a current that is constant, linear in depth, gusts, and a current that others add. */
class CCurrent
{
   public:
	/** `step` [s]: that of the integration. */
	CCurrent(const TCurrentOptions& options, double step, uint64_t seed);

	/** On by one step of the integration. */
	void advance();
	/** Adds this from time t [s] on, map axes [m/s], instead of what was added before. */
	void setAdded(double t, const Eigen::Vector3d& velocity);
	/** t [s] within the present step, depth [m]. */
	TWaterMotion at(double t, double depth) const;

   private:
	void addGust(double t, TWaterMotion& water) const;

	Eigen::Vector3d m_at_surface, m_shear;
	/** Gusts are drawn at knots, a tenth of their correlation time apart, with a smooth way between. */
	int m_steps_a_knot;
	double m_step;
	CGaussMarkov<2> m_gusts;  ///< North, east [m/s]
	uint64_t m_steps{0}, m_knot_step{0};
	Eigen::Vector2d m_gust_before, m_gust_after;
	double m_onset, m_added_since{0};
	Eigen::Vector3d m_added{0, 0, 0}, m_added_before{0, 0, 0};
};
}  // namespace posidonia
