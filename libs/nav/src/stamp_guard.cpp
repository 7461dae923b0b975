#include <posidonia/nav/stamp_guard.h>

#include <cmath>

namespace posidonia
{
EArrival CStampGuard::judge(double stamp, double newest, double horizon)
{
	const bool ahead = stamp > newest + m_max_jump, gone = stamp < newest && !(stamp >= horizon);
	if (!ahead && !gone) {
		m_agreeing = 0;
		return stamp < newest ? EArrival::LATE : EArrival::IN_ORDER;
	}
	const int agree = agreeing(stamp);
	if (ahead) return agree >= kForward ? EArrival::IN_ORDER : EArrival::JUMPED;
	return agree >= kBack ? EArrival::CLOCK_RESET : EArrival::TOO_LATE;
}

int CStampGuard::agreeing(double stamp)
{
	m_agreeing = m_agreeing > 0 && std::abs(stamp - m_candidate) <= m_max_jump ? m_agreeing + 1 : 1;
	m_candidate = stamp;
	return m_agreeing;
}
}  // namespace posidonia
