#include <posidonia/control/safety_supervisor.h>

#include <algorithm>

namespace posidonia
{
namespace
{
using IN = TSafetyInput;
using LIMITS = TSafetyOptions;

constexpr double kGpsDepth = 1.0;  // COLA2: deeper, no GPS is expected [m]

bool tooLow(const IN& in, const LIMITS& limits)
{
	const auto& navigation = in.navigation;
	return isFresh(navigation, in.health, limits) && navigation.altitude && *navigation.altitude > 0 &&
		   *navigation.altitude < limits.min_altitude && !navigation.afloat();
}

bool deeperThan(double depth, const IN& in, const LIMITS& limits)
{
	return isFresh(in.navigation, in.health, limits) && in.navigation.depth() > depth;
}

bool outsideCage(const IN& in, const LIMITS& limits)
{
	if (limits.cage.size() != 4 || !isFresh(in.navigation, in.health, limits)) return false;
	const double north = in.navigation.north(), east = in.navigation.east();
	return north < limits.cage[0] || east < limits.cage[1] || north > limits.cage[2] || east > limits.cage[3];
}

bool stillUnderWater(const IN& in, const LIMITS& limits)
{
	const bool afloat = isFresh(in.navigation, in.health, limits) && in.navigation.afloat();
	return in.emergency_for > limits.drop_weight_after && !afloat;
}

bool noPositionAfloat(const IN& in, const LIMITS& limits)
{
	return in.health.position_age > limits.position_timeout && !deeperThan(kGpsDepth, in, limits);
}
}  // namespace

std::string toString(ESafetyLevel level)
{
	switch (level) {
		case ESafetyLevel::NONE:
			return "none";
		case ESafetyLevel::INFORMATIVE:
			return "informative";
		case ESafetyLevel::ABORT:
			return "abort";
		case ESafetyLevel::ABORT_AND_SURFACE:
			return "abort and surface";
		case ESafetyLevel::EMERGENCY_SURFACE:
			return "emergency surface";
		default:
			return "drop weight";
	}
}

bool isFresh(const TControlState& navigation, const TVehicleHealth& health, const TSafetyOptions& limits)
{
	return navigation.valid && health.navigation_age <= limits.navigation_pause;
}

const std::vector<TSafetyRule>& safetyRules()
{
	using L = ESafetyLevel;
	// clang-format off
	static const std::vector<TSafetyRule> rules{
		{"low altitude", "0 < altitude < limit, under water", "min_altitude", L::INFORMATIVE, true, tooLow},
		{"deep", "depth > limit", "max_depth", L::INFORMATIVE, true,
			[](const IN& in, const LIMITS& l) { return deeperThan(l.max_depth, in, l); }},
		{"too deep", "depth > max_depth + limit", "depth_margin", L::ABORT_AND_SURFACE, true,
			[](const IN& in, const LIMITS& l) { return deeperThan(l.max_depth + l.depth_margin, in, l); }},
		{"outside the cage", "position outside limit", "cage", L::ABORT, false, outsideCage},
		{"stale navigation", "age > limit", "navigation_timeout", L::EMERGENCY_SURFACE, false,
			[](const IN& in, const LIMITS& l) { return in.health.navigation_age > l.navigation_timeout; }},
		{"no depth", "age > limit", "depth_timeout", L::EMERGENCY_SURFACE, false,
			[](const IN& in, const LIMITS& l) { return in.health.depth_age > l.depth_timeout; }},
		{"no IMU", "age > limit", "imu_timeout", L::ABORT_AND_SURFACE, false,
			[](const IN& in, const LIMITS& l) { return in.health.imu_age > l.imu_timeout; }},
		{"no DVL", "age > limit", "dvl_timeout", L::ABORT_AND_SURFACE, false,
			[](const IN& in, const LIMITS& l) { return in.health.dvl_age > l.dvl_timeout; }},
		{"no good DVL", "age > limit", "good_dvl_timeout", L::ABORT_AND_SURFACE, false,
			[](const IN& in, const LIMITS& l) { return in.health.good_dvl_age > l.good_dvl_timeout; }},
		{"no altitude", "age > limit", "altitude_timeout", L::ABORT_AND_SURFACE, false,
			[](const IN& in, const LIMITS& l) { return in.health.altitude_age > l.altitude_timeout; }},
		{"no position", "age > limit, at the surface", "position_timeout", L::INFORMATIVE, false, noPositionAfloat},
		{"battery low", "charge < limit", "min_battery", L::ABORT_AND_SURFACE, false,
			[](const IN& in, const LIMITS& l) { return in.health.battery < l.min_battery; }},
		{"battery warning", "charge < 1.5 limit", "min_battery", L::INFORMATIVE, false,
			[](const IN& in, const LIMITS& l) { return in.health.battery < 1.5 * l.min_battery; }},
		{"mission time-out", "mission time > limit", "[Mission] timeout", L::ABORT_AND_SURFACE, false,
			[](const IN& in, const LIMITS&) { return in.health.mission_time > in.mission_timeout; }},
		{"never navigated", "mission time > limit, no pose yet", "[Mission] timeout", L::EMERGENCY_SURFACE, false,
			[](const IN& in, const LIMITS&) { return in.health.mission_time > in.mission_timeout && !in.navigation.valid; }},
		{"not rising", "emergency for > limit, not afloat", "drop_weight_after", L::DROP_WEIGHT, false, stillUnderWater},
	};
	// clang-format on
	return rules;
}

CSafetySupervisor::CSafetySupervisor(const TSafetyOptions& options, double mission_timeout)
	: m_options(options), m_mission_timeout(mission_timeout)
{
}

void CSafetySupervisor::raise(ESafetyLevel level)
{
	if (level >= ESafetyLevel::ABORT) m_latched = std::max(m_latched, level);
}

ESafetyLevel CSafetySupervisor::levelOf(const TSafetyRule& rule, const TSafetyInput& input) const
{
	const bool settling = input.health.initialised_for < m_options.settle_time;
	const bool abort = rule.level == ESafetyLevel::ABORT || rule.level == ESafetyLevel::ABORT_AND_SURFACE;
	return settling && abort ? ESafetyLevel::INFORMATIVE : rule.level;
}

TSafetyDecision CSafetySupervisor::update(const TControlState& navigation, const TVehicleHealth& health)
{
	TSafetyInput input{navigation, health, m_mission_timeout, 0};
	if (m_emergency_since >= 0) input.emergency_for = health.stamp - m_emergency_since;
	TSafetyDecision decision;
	for (const TSafetyRule& rule : safetyRules()) {
		if (!rule.holds(input, m_options)) continue;
		const ESafetyLevel level = levelOf(rule, input);
		raise(level);
		decision.level = std::max(decision.level, level);
		decision.climb = decision.climb || rule.climbs;
		decision.rules += (decision.rules.empty() ? "" : ", ") + std::string(rule.name);
	}
	decision.level = std::max(decision.level, m_latched);
	if (m_emergency_since < 0 && m_latched >= ESafetyLevel::EMERGENCY_SURFACE)
		m_emergency_since = health.stamp;
	return decision;
}
}  // namespace posidonia
