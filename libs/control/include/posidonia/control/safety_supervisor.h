#pragma once

#include <posidonia/control/control_state.h>
#include <posidonia/control/safety_options.h>

#include <string>
#include <vector>

namespace posidonia
{
/** Severity, in rising order (COLA2's levels). */
enum class ESafetyLevel
{
	NONE,
	INFORMATIVE,		///< Told, nothing else
	ABORT,				///< Mission over; the vehicle stops
	ABORT_AND_SURFACE,	///< Mission over; up, by the controllers
	EMERGENCY_SURFACE,	///< Up, by open-loop set-points: nothing is trusted
	DROP_WEIGHT			///< As before, and the drop weight goes
};
std::string toString(ESafetyLevel level);

/** What a rule looks at. */
struct TSafetyInput
{
	const TControlState& navigation;  ///< The last one; valid only when health says that it is fresh
	const TVehicleHealth& health;
	double mission_timeout{3600};  ///< [s]
	double emergency_for{0};	   ///< Since the emergency surfacing began, 0 before [s]
};

/** A row of the table. */
struct TSafetyRule
{
	const char* name;		///< "stale navigation"
	const char* condition;	///< "navigation_age > navigation_timeout"
	const char* limit_key;	///< The key of [Safety] (or [Mission]) with its limit
	ESafetyLevel level;
	bool climbs;  ///< While it holds, the vehicle climbs at climb_speed with priority SAFETY_HIGH
	bool (*holds)(const TSafetyInput&, const TSafetyOptions&);
};

/** Is there a pose that may be used? */
bool isFresh(const TControlState& navigation, const TVehicleHealth& health, const TSafetyOptions& limits);

/** The rule table (COLA2's safe_depth_altitude, virtual cage and supervisor rules; libs/control/README.md).
 */
const std::vector<TSafetyRule>& safetyRules();

/** What is to be done now. */
struct TSafetyDecision
{
	ESafetyLevel level{ESafetyLevel::NONE};
	bool climb{false};
	std::string rules;	///< Names of the rules that hold, ", " between; for the log
};

/** Looks at every rule at each step. ABORT and worse are latched: only a new mission clears them. */
class CSafetySupervisor
{
   public:
	CSafetySupervisor(const TSafetyOptions& options, double mission_timeout);
	TSafetyDecision update(const TControlState& navigation, const TVehicleHealth& health);
	/** Raises the level from outside (a step that timed out, an operator). */
	void raise(ESafetyLevel level);
	ESafetyLevel level() const { return m_latched; }

   private:
	ESafetyLevel levelOf(const TSafetyRule& rule, const TSafetyInput& input) const;

	TSafetyOptions m_options;
	double m_mission_timeout;
	ESafetyLevel m_latched{ESafetyLevel::NONE};
	double m_emergency_since{-1};  ///< Stamp [s], negative before
};
}  // namespace posidonia
