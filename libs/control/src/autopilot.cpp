#include <posidonia/control/autopilot.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
namespace
{
constexpr double kAtRest = 0.05;  // [m/s]
}  // namespace

CAutopilot::CAutopilot(const TAutopilotOptions& options, const TMission& mission)
	: m_options(options),
	  m_runner(mission, options.guidance),
	  m_observer(options.current_observer),
	  m_pose(options.pose_control),
	  m_velocity(options.velocity_control),
	  m_allocation(options.allocation),
	  m_supervisor(options.safety, mission.options.timeout)
{
}

TAutopilotOutput CAutopilot::step(const TControlState& navigation, const TVehicleHealth& health)
{
	TAutopilotOutput out;
	out.stamp = health.stamp;
	const double dt = m_stamp < 0 ? 0 : health.stamp - m_stamp;
	m_stamp = health.stamp;
	supervise(navigation, health, out);
	const bool fresh = isFresh(navigation, health, m_options.safety);
	if (m_decision.level >= ESafetyLevel::EMERGENCY_SURFACE)
		surfaceBlindly(health.stamp, out);
	else if (fresh) {
		request(navigation, dt, out);
		control(navigation, dt, out);
		observeCurrent(navigation, dt, out);
	}
	else
		pause();
	out.step = m_runner.step();
	out.leg = m_runner.progress();
	out.finished = finished(navigation, fresh);
	return out;
}

void CAutopilot::supervise(
	const TControlState& navigation, const TVehicleHealth& health, TAutopilotOutput& out)
{
	const ESafetyLevel before = m_decision.level;
	m_decision = m_supervisor.update(navigation, health);
	out.level = m_decision.level;
	out.drop_weight = m_decision.level == ESafetyLevel::DROP_WEIGHT;
	if (out.level == before) return;
	const std::string why = m_decision.rules.empty() ? "" : ": " + m_decision.rules;
	out.events.push_back({health.stamp, EMissionEvent::SAFETY_LEVEL, toString(out.level) + why});
	if (before < ESafetyLevel::ABORT && out.level >= ESafetyLevel::ABORT)
		out.events.push_back({health.stamp, EMissionEvent::MISSION_ABORTED, m_decision.rules});
}

void CAutopilot::request(const TControlState& navigation, double dt, TAutopilotOutput& out)
{
	m_acceleration = {};
	m_requests.put({"idle", out.stamp, PRIORITY_SAFETY_LOW, 0.0, 0.0, 0.0});
	if (m_decision.level >= ESafetyLevel::ABORT)
		requestAbort(dt, out);
	else
		requestMission(navigation, dt, out);
	if (!m_decision.climb) return;
	m_requests.put({"climb", out.stamp, PRIORITY_SAFETY_HIGH, {}, -m_options.safety.climb_speed, {}});
	m_acceleration.heave = 0;
}

void CAutopilot::requestMission(const TControlState& navigation, double dt, TAutopilotOutput& out)
{
	const TGuidanceCommand guidance = m_runner.update(navigation, m_observer.current(), dt, out.events);
	if (m_runner.aborts()) m_supervisor.raise(ESafetyLevel::ABORT_AND_SURFACE);
	out.unlimited = m_pose.command(guidance, navigation);
	out.limited = m_pose.limited(out.unlimited, dt);
	out.heading_reference = guidance.heading.value;
	out.depth_reference = guidance.depth.value;
	m_acceleration = {guidance.surge_rate, guidance.depth.acceleration, guidance.heading.acceleration};
	// Two requests: a climb takes the heave and leaves the course.
	m_requests.put({"course", out.stamp, PRIORITY_NORMAL, out.limited.surge, {}, out.limited.yaw_rate});
	m_requests.put({"depth", out.stamp, PRIORITY_NORMAL, {}, out.limited.heave, {}});
}

void CAutopilot::requestAbort(double dt, TAutopilotOutput& out)
{
	const bool up = m_decision.level == ESafetyLevel::ABORT_AND_SURFACE;
	out.unlimited = {0, up ? -m_options.safety.ascent_speed : 0, 0};
	out.limited = m_pose.limited(out.unlimited, dt);
	m_requests.put(
		{"abort", out.stamp, PRIORITY_SAFETY, out.limited.surge, out.limited.heave, out.limited.yaw_rate});
}

void CAutopilot::control(const TControlState& navigation, double dt, TAutopilotOutput& out)
{
	const TVelocityCommand command = m_requests.merged(out.stamp);
	const TVelocityCommand measured{navigation.v_body.x(), navigation.v_body.z(), navigation.omega_body.z()};
	const double heading = navigation.heading();
	out.current = m_observer.current();
	TVelocityCommand through_water = command;
	through_water.surge -= out.current.dot(Eigen::Vector2d(std::cos(heading), std::sin(heading)));
	out.wanted = m_velocity.update(command, measured, m_acceleration, through_water, dt);
	const TThrusters thrusts = m_allocation.thrusts(out.wanted);
	m_velocity.noteAchieved(m_allocation.wrench(thrusts));
	out.set_points = m_allocation.setPoints(thrusts);
	out.achieved = m_allocation.wrench(m_allocation.thrustsOf(out.set_points));
}

void CAutopilot::observeCurrent(const TControlState& navigation, double dt, TAutopilotOutput& out)
{
	m_observer.update(
		{navigation.heading(), navigation.omega_body.z(), navigation.v_body.head<2>(), out.achieved.X}, dt);
}

void CAutopilot::surfaceBlindly(double now, TAutopilotOutput& out)
{
	if (m_emergency_since < 0) m_emergency_since = now;
	const double ramp = std::min(1.0, (now - m_emergency_since) / m_options.safety.emergency_ramp);
	out.set_points.heave = -m_options.safety.emergency_heave * ramp;
	out.achieved = m_allocation.wrench(m_allocation.thrustsOf(out.set_points));
	pause();
}

void CAutopilot::pause()
{
	m_velocity.reset();
	m_pose.reset({});
}

bool CAutopilot::finished(const TControlState& navigation, bool fresh) const
{
	switch (m_decision.level) {
		case ESafetyLevel::NONE:
		case ESafetyLevel::INFORMATIVE:
			return m_runner.done();
		case ESafetyLevel::ABORT:
			return fresh && navigation.v_body.norm() < kAtRest;
		case ESafetyLevel::DROP_WEIGHT:
			return true;
		default:
			return fresh && navigation.afloat();
	}
}
}  // namespace posidonia
