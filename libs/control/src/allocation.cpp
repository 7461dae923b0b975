#include <posidonia/control/allocation.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
namespace
{
/** Largest factor in [0, 1] with lo <= base + factor * add <= hi, for base in the range. */
double roomFor(double base, double add, double lo, double hi)
{
	if (add > 0) return std::min(1.0, (hi - base) / add);
	if (add < 0) return std::min(1.0, (lo - base) / add);
	return 1;
}

double setPointOf(double thrust, double forward, double reverse, double dead_band)
{
	const double full = thrust >= 0 ? forward : reverse;
	const double s = std::sqrt(std::min(1.0, std::abs(thrust) / full));
	// Inside the dead band: whichever of nothing and its edge is nearer in thrust.
	const double nearest = s >= dead_band ? s : (2 * s * s >= dead_band * dead_band ? dead_band : 0);
	return std::copysign(nearest, thrust);
}

double thrustOf(double set_point, double forward, double reverse, double dead_band)
{
	const double s = std::clamp(set_point, -1.0, 1.0);
	if (std::abs(s) < dead_band) return 0;
	return (s >= 0 ? forward : reverse) * s * std::abs(s);
}
}  // namespace

TThrusters CThrusterAllocation::thrusts(const TWrench& wanted) const
{
	const auto& o = m_options;
	TThrusters T;
	const double couple = 0.5 * wanted.N / o.arm;
	const double yaw = std::min(
		roomFor(0, couple, -o.surge_reverse, o.surge_forward),
		roomFor(0, -couple, -o.surge_reverse, o.surge_forward));
	T.port = yaw * couple;
	T.starboard = -yaw * couple;
	const double each = 0.5 * wanted.X;
	const double surge = std::min(
		roomFor(T.port, each, -o.surge_reverse, o.surge_forward),
		roomFor(T.starboard, each, -o.surge_reverse, o.surge_forward));
	T.port += surge * each;
	T.starboard += surge * each;
	T.heave = std::clamp(wanted.Z, -o.heave_reverse, o.heave_forward);
	return T;
}

TWrench CThrusterAllocation::wrench(const TThrusters& T) const
{
	return {T.starboard + T.port, T.heave, m_options.arm * (T.port - T.starboard)};
}

TThrusters CThrusterAllocation::setPoints(const TThrusters& T) const
{
	const auto& o = m_options;
	return {
		setPointOf(T.starboard, o.surge_forward, o.surge_reverse, o.dead_band),
		setPointOf(T.port, o.surge_forward, o.surge_reverse, o.dead_band),
		setPointOf(T.heave, o.heave_forward, o.heave_reverse, o.dead_band)};
}

TThrusters CThrusterAllocation::thrustsOf(const TThrusters& s) const
{
	const auto& o = m_options;
	return {
		thrustOf(s.starboard, o.surge_forward, o.surge_reverse, o.dead_band),
		thrustOf(s.port, o.surge_forward, o.surge_reverse, o.dead_band),
		thrustOf(s.heave, o.heave_forward, o.heave_reverse, o.dead_band)};
}
}  // namespace posidonia
