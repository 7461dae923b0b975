#pragma once

#include <posidonia/base/options.h>

#include <string>
#include <vector>

/** Keys of [Step.N], by what a kind of step needs: a key that a kind does not use is unknown there. */
namespace posidonia
{
/** Keys of every step. */
struct TStepKeys
{
	std::string kind{"goto"};
	std::vector<double> depth, altitude;
	double vertical_speed{0.2}, tolerance_z{0.1};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice(
			"kind", kind, {"goto", "section", "route", "lawn-mower", "dive", "hold", "surface"},
			"What to do");
		v.numbers("depth", depth, 0, atLeast(0), "Set-point [m]; neither depth nor altitude: as before");
		v.numbers("altitude", altitude, 0, above(0), "Set-point over the floor [m]");
		v.number("vertical_speed", vertical_speed, above(0), "Of the depth set-point [m/s]");
		v.number("tolerance_z", tolerance_z, above(0), "Reached within this vertical distance [m]");
	}
};

/** Keys of steps that name points. */
struct TPointKeys
{
	std::vector<double> points, geodetic_points;

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.numbers("points", points, 0, anyNumber(), "North east [m] of each point");
		v.numbers(
			"geodetic_points", geodetic_points, 0, between(-180, 180),
			"Latitude longitude [deg] of each, instead of points");
	}
};

/** Keys of steps that move. */
struct TLegKeys
{
	double speed{0.3}, tolerance_xy{0.15};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("speed", speed, above(0), "Over ground along the line [m/s]");
		v.number("tolerance_xy", tolerance_xy, above(0), "Reached within this horizontal distance [m]");
	}
};

struct TLawnMowerKeys
{
	double heading{0}, length{10}, spacing{1};
	int tracks{4};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.degrees("heading", heading, anyNumber(), "Of the first track [deg]");
		v.number("length", length, above(0), "Of each track [m]");
		v.number("spacing", spacing, anyNumber(), "Between tracks, positive to starboard of the first [m]");
		v.integer("tracks", tracks, atLeast(1), "How many");
	}
};

struct TTimeoutKeys
{
	double timeout{0};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"timeout", timeout, atLeast(0),
			"The next step starts after this time [s]; 0: 2 max(sqrt2 d / u, dz / min(0.3, w)) + 30 s "
			"(COLA2)");
	}
};

struct THoldKeys
{
	double duration{20};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("duration", duration, atLeast(0), "Time on station [s]");
	}
};
}  // namespace posidonia
