#include <posidonia/control/delayed_corrections.h>

namespace posidonia
{
void CDelayedCorrections::push(const TCorrection& correction)
{
	m_queue.push_back(correction);
}

std::optional<TCorrection> CDelayedCorrections::takeVisible(double now)
{
	std::optional<TCorrection> newest;
	for (; !m_queue.empty() && m_queue.front().stamp + m_latency <= now; m_queue.pop_front())
		newest = m_queue.front();
	return newest;
}
}  // namespace posidonia
