#include <posidonia/control/velocity_requests.h>

#include <algorithm>

namespace posidonia
{
void CVelocityRequests::put(const TVelocityRequest& request)
{
	const auto same = [&](const TVelocityRequest& other) { return other.requester == request.requester; };
	m_requests.erase(std::remove_if(m_requests.begin(), m_requests.end(), same), m_requests.end());
	const auto lower = [&](const TVelocityRequest& other) { return other.priority < request.priority; };
	m_requests.insert(std::find_if(m_requests.begin(), m_requests.end(), lower), request);
}

namespace
{
/** An axis while requests are merged into it. */
struct TAxis
{
	double value{0};
	int priority{0};  ///< Of who took it; 0: nobody

	bool takenFrom(const std::optional<double>& wish, int by) const { return wish && priority > by; }
	void add(const std::optional<double>& wish, int by)
	{
		if (!wish) return;
		value += *wish;
		priority = by;
	}
};
}  // namespace

TVelocityCommand CVelocityRequests::merged(double now) const
{
	TAxis surge, heave, yaw_rate;
	for (const auto& request : m_requests) {
		const int by = request.priority;
		const bool blocked = surge.takenFrom(request.surge, by) || heave.takenFrom(request.heave, by) ||
							 yaw_rate.takenFrom(request.yaw_rate, by);
		if (now - request.stamp > kExpiry || blocked) continue;
		surge.add(request.surge, by);
		heave.add(request.heave, by);
		yaw_rate.add(request.yaw_rate, by);
	}
	return {surge.value, heave.value, yaw_rate.value};
}
}  // namespace posidonia
