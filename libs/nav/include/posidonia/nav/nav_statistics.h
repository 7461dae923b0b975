#pragma once

#include <limits>
#include <map>
#include <string>

namespace posidonia
{
/** Fate of one sensor's observations. */
struct TSensorCount
{
	size_t used{0};
	size_t gated{0};		 ///< Refused by the chi-square gate
	size_t gated_in_row{0};	 ///< At present; many: the filter may have lost its way
	size_t gave_way{0};		 ///< Times that the filter gave way to it (README, "Gate")
	size_t invalid{0};		 ///< No bottom lock, no fix, not a number, too fast
	size_t late{0};			 ///< Stamp before the filter's present: dropped
	size_t idle{0};			 ///< Good but not needed: before the start, switched off, a second gyro
	double longest_gap{0};	 ///< Between readings that were used [s]
	double last_used{std::numeric_limits<double>::quiet_NaN()};	 ///< Stamp [s]

	void use(double stamp);
};

/** Counts by sensorLabel. */
struct TNavStatistics
{
	std::map<std::string, TSensorCount> sensors;

	/** One line a sensor, for logs. */
	std::string text() const;
};
}  // namespace posidonia
