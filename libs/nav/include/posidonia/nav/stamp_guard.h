#pragma once

#include <cstddef>
#include <limits>

namespace posidonia
{
/** What to do with a reading, by its stamp alone. */
enum class EArrival
{
	IN_ORDER,
	LATE,		  ///< Within the horizon: to be put in its place
	TOO_LATE,	  ///< Beyond it
	JUMPED,		  ///< Far ahead of all others
	CLOCK_RESET,  ///< Many in a row agree on a time long past: the clock was set back
};

/** Keeps one wrong stamp from taking the filter into the future, and lets a clock that was really set have
 * its way: after `kForward` readings in a row that agree with each other (or `kBack` for a time that is
 * gone). */
class CStampGuard
{
   public:
	explicit CStampGuard(double max_jump) : m_max_jump(max_jump) {}
	/** `newest`: stamp of the newest reading taken, NaN before the first; `horizon`: oldest that can be put
	 * in its place. */
	EArrival judge(double stamp, double newest, double horizon);

   private:
	static constexpr int kForward = 5, kBack = 20;
	/** How many in a row, this one included, are near each other? */
	int agreeing(double stamp);
	double m_max_jump;
	double m_candidate{std::numeric_limits<double>::quiet_NaN()};
	int m_agreeing{0};
};
}  // namespace posidonia
