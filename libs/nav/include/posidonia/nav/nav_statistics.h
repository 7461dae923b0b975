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
	size_t inconsistent{0};	 ///< Four beams that contradict each other (error velocity)
	size_t invalid{0};		 ///< No bottom lock, no fix, a fix from the deep, not a number, too fast
	size_t duplicate{0};	 ///< A second reading with the same stamp
	size_t jumped{0};		 ///< Stamp far ahead of all others, or of a clock that went back: dropped
	size_t replayed{0};		 ///< Late, but put in its place
	size_t late{0};			 ///< Too late to be put in its place: dropped
	size_t idle{0};			 ///< Good but not needed: before the start, switched off, a second gyro
	size_t outages{0};		 ///< Silences longer than the time-out
	double outage_time{0};	 ///< Of these, all together [s]
	double longest_gap{0};	 ///< Between readings that were used [s]
	double last_used{std::numeric_limits<double>::quiet_NaN()};	 ///< Stamp [s]

	/** `time_out` [s]; 0: the sensor may be silent. */
	void use(double stamp, double time_out);
	/** What was counted on arrival and what was counted by the filter, together. */
	TSensorCount plus(const TSensorCount& on_arrival) const;
	/** "used 10, gated 2": what is not zero. */
	std::string text() const;
};

/** Counts by sensorLabel, and of the whole. */
struct TNavStatistics
{
	std::map<std::string, TSensorCount> sensors;
	size_t replays{0};		  ///< Times that the history was replayed
	size_t edges_revised{0};  ///< Edges that late readings changed before they were final
	size_t edges_kept{0};	  ///< Edges that were final when later readings changed the filter below them
	size_t clock_resets{0};	  ///< The clock went back and the history with it was dropped
	double drag_time{0};	  ///< Bridged by the drag model [s]

	/** One line a sensor, for logs. */
	std::string text() const;
};
}  // namespace posidonia
