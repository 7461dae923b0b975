#pragma once

#include <posidonia/control/commands.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace posidonia
{
/** COLA2's priorities. */
enum ERequestPriority
{
	PRIORITY_SAFETY_LOW = 5,   ///< Zero velocity on axes that nobody uses
	PRIORITY_NORMAL = 10,	   ///< The mission
	PRIORITY_SAFETY = 30,	   ///< Stop
	PRIORITY_SAFETY_HIGH = 50  ///< Climb from the floor
};

/** Wish of one requester; an axis without a value is left to others. */
struct TVelocityRequest
{
	std::string requester;
	double stamp{0};  ///< [s]
	int priority{PRIORITY_NORMAL};
	std::optional<double> surge, heave, yaw_rate;  ///< [m/s], [m/s], [rad/s]
};

/** Merges velocity requests (COLA2): by falling priority, a request is merged only if none of its axes was
 * taken by a higher one; requests of the same priority add. A requester's last request counts and expires
 * after 0.3 s. */
class CVelocityRequests
{
   public:
	static constexpr double kExpiry = 0.3;	///< Three periods of 10 Hz [s]

	void put(const TVelocityRequest& request);
	/** Axes without a request are 0. */
	TVelocityCommand merged(double now) const;

   private:
	std::vector<TVelocityRequest> m_requests;  ///< One a requester, by falling priority
};
}  // namespace posidonia
