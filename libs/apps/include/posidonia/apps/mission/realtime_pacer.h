#pragma once

#include <chrono>

namespace posidonia
{
/** Holds a simulation back to the clock. A step that comes later than its time by more than `tolerance` has
 * missed its deadline. */
class CRealtimePacer
{
   public:
	/** Not active: nothing waits, nothing is missed. */
	CRealtimePacer(bool active, double tolerance) : m_active(active), m_tolerance(tolerance) {}
	/** Waits until `t` seconds after the first call's t. */
	void waitFor(double t);

	int missed() const { return m_missed; }
	double worst() const { return m_worst; }  ///< Lateness [s]

   private:
	using clock_t = std::chrono::steady_clock;
	bool m_active;
	double m_tolerance, m_worst{0};
	int m_missed{0};
	bool m_started{false};
	clock_t::time_point m_start;
	double m_first{0};
};
}  // namespace posidonia
