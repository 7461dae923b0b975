#pragma once

#include <posidonia/base/options.h>
#include <posidonia/sim/smooth_profile.h>

#include <Eigen/Dense>
#include <vector>

namespace posidonia
{
/** Section [Route]: where the vehicle goes. Default: the paper's Table 1. */
struct TRouteOptions
{
	std::vector<double> start{0, 0, 0, 90};
	/** Table 1 of the paper: 18 set points. */
	std::vector<double> way_points{0,  0,	0, 12,	5, 12, 5, 6,  -5, 6,   -5, 0,	5,	0,	5, -6, -5, -6,
								   -5, -12, 5, -12, 5, 12, 0, 12, 0,  -12, -5, -12, -5, 12, 0, 12, 0,  0};
	double depth{3.5}, speed{0.3}, acceleration{0.15};
	double turn_rate{20 * M_PI / 180};
	double dwell{2};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.numbers("start", start, 4, anyNumber(), "Body at the start: north east down [m] heading [deg]");
		v.numbers(
			"way_points", way_points, 0, anyNumber(), "North east [m] of each set point (default: Table 1)");
		v.number("depth", depth, anyNumber(), "Depth of the set points [m] (paper: 3.5)");
		v.number("speed", speed, above(0), "Speed on the legs [m/s] (paper: 0.3)");
		v.number("acceleration", acceleration, above(0), "Peak acceleration at the ends of a leg [m/s^2]");
		v.degrees("turn_rate", turn_rate, above(0), "Peak yaw rate of turns on the spot [deg/s]");
		v.number("dwell", dwell, atLeast(0), "Rest at the start [s]");
	}
};

/** Position with derivatives in map, heading with derivatives. */
struct TPlannedState
{
	Eigen::Vector3d position, velocity, acceleration;  ///< map [m], [m/s], [m/s^2]
	TProfileValue heading;							   ///< [rad], [rad/s], [rad/s^2]
};

/** Rest at the start, dive to the first set point, then turn on the spot and leg, set point by set point. */
class CRoutePlan
{
   public:
	/** Throws CError when way_points is no list of pairs. */
	explicit CRoutePlan(const TRouteOptions& options);

	/** The plan at t [s] from the start, in closed form; at rest before 0 and after duration(). */
	TPlannedState at(double t) const;
	double duration() const { return m_end.start; }	 ///< [s]
	double length() const { return m_length; }		 ///< Travelled distance [m], dive included
	/** Start and set points [m, map] with the times [s] at which the vehicle rests there. */
	struct TArrival
	{
		double t;
		Eigen::Vector3d position;
	};
	const std::vector<TArrival>& arrivals() const { return m_arrivals; }

   private:
	/** A leg, a turn on the spot or a rest. */
	struct TSegment
	{
		double start{0}, duration{0};  ///< [s]
		Eigen::Vector3d from{0, 0, 0}, direction{0, 0, 0};
		CLegProfile leg;
		double heading{0}, turn{0};	 ///< [rad]
	};
	void append(const TSegment& segment);
	void appendTurnTo(double heading, double peak_rate);
	void appendLegTo(const Eigen::Vector3d& point, const TRouteOptions& options);

	std::vector<TSegment> m_segments;
	TSegment m_end;	 ///< What the next segment starts from
	double m_length{0};
	std::vector<TArrival> m_arrivals;
};
}  // namespace posidonia
