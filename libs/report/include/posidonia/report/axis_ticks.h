#pragma once

#include <string>
#include <vector>

namespace posidonia
{
/** Round numbers along an axis. */
struct TTicks
{
	double step{1};				 ///< 1, 2 or 5 times a power of ten, unit of the axis
	std::vector<double> values;	 ///< ascending whole multiples of step inside the range

	/** A tick's number with just the decimals that `step` needs. */
	std::string label(double value) const;
};

/** About `wanted` ticks (half to twice as many) in [min, max], min < max finite. */
TTicks roundTicks(double min, double max, int wanted);
}  // namespace posidonia
