#include <posidonia/apps/mission/realtime_pacer.h>

#include <algorithm>
#include <thread>

namespace posidonia
{
void CRealtimePacer::waitFor(double t)
{
	if (!m_active) return;
	if (!m_started) {
		m_started = true;
		m_start = clock_t::now();
		m_first = t;
	}
	const auto due =
		m_start + std::chrono::duration_cast<clock_t::duration>(std::chrono::duration<double>(t - m_first));
	const double late = std::chrono::duration<double>(clock_t::now() - due).count();
	m_worst = std::max(m_worst, late);
	m_missed += late > m_tolerance;
	std::this_thread::sleep_until(due);
}
}  // namespace posidonia
