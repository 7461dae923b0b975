#include <posidonia/control/mission_runner.h>

namespace posidonia
{
using Eigen::Vector2d;

std::string toString(EMissionEvent kind)
{
	switch (kind) {
		case EMissionEvent::STEP_STARTED:
			return "step started";
		case EMissionEvent::STEP_REACHED:
			return "step reached";
		case EMissionEvent::STEP_TIMED_OUT:
			return "step timed out";
		case EMissionEvent::MISSION_DONE:
			return "mission done";
		case EMissionEvent::MISSION_ABORTED:
			return "mission aborted";
		default:
			return "safety level";
	}
}

void CMissionRunner::begin(
	const TControlState& navigation, const Vector2d& current, std::vector<TMissionEvent>& events)
{
	const TStep& step = m_mission.steps[m_step];
	std::optional<Vector2d> before;
	if (m_step > 0) before = m_guidance.end();
	m_guidance.begin(step, before, navigation, current);
	m_begun = navigation.stamp;
	const double distance = (m_guidance.end() - navigation.horizontal()).norm();
	m_timeout = step.timeout > 0 ? step.timeout : defaultTimeout(step, distance, m_guidance.climb());
	events.push_back({navigation.stamp, EMissionEvent::STEP_STARTED, step.name});
}

void CMissionRunner::end(
	EMissionEvent how, const TControlState& navigation, const Vector2d& current,
	std::vector<TMissionEvent>& events)
{
	events.push_back({navigation.stamp, how, m_mission.steps[m_step].name});
	m_aborts = how == EMissionEvent::STEP_TIMED_OUT && m_mission.options.on_timeout == "abort";
	m_step++;
	if (done())
		events.push_back({navigation.stamp, EMissionEvent::MISSION_DONE, ""});
	else if (!m_aborts)
		begin(navigation, current, events);
}

TGuidanceCommand CMissionRunner::update(
	const TControlState& navigation, const Vector2d& current, double dt, std::vector<TMissionEvent>& events)
{
	if (!m_started) begin(navigation, current, events);
	m_started = true;
	const TGuidanceCommand command = m_guidance.update(navigation, current, dt);
	if (done()) return command;
	if (m_guidance.reached(navigation))
		end(EMissionEvent::STEP_REACHED, navigation, current, events);
	else if (navigation.stamp - m_begun > m_timeout)
		end(EMissionEvent::STEP_TIMED_OUT, navigation, current, events);
	return command;
}
}  // namespace posidonia
