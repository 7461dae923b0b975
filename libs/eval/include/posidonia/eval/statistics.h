#pragma once

#include <cstddef>
#include <vector>

namespace posidonia
{
/** evo's names (github.com/MichaelGrupp/evo): std is the population's (divided by n), sse the sum of squares.
 */
struct TStatistics
{
	size_t count{0};
	double max{0}, mean{0}, median{0}, min{0}, rmse{0}, sse{0}, std{0};	 ///< unit of the values; sse: squared
};

/** All zero for no values. */
TStatistics statistics(std::vector<double> values);
}  // namespace posidonia
