#pragma once

#include <posidonia/control/mission_event.h>
#include <posidonia/control/step_guidance.h>

#include <vector>

namespace posidonia
{
/** Goes through the steps of a mission (COLA2's captain). After the last one it keeps station there. */
class CMissionRunner
{
   public:
	CMissionRunner(const TMission& mission, const TGuidanceOptions& options)
		: m_mission(mission), m_guidance(options)
	{
	}

	/** Appends to `events` what happened. */
	TGuidanceCommand update(
		const TControlState& navigation, const Eigen::Vector2d& current, double dt,
		std::vector<TMissionEvent>& events);

	/** Index of the present step; size() of the steps when the mission is done. */
	size_t step() const { return m_step; }
	bool done() const { return m_step == m_mission.steps.size(); }
	/** A step timed out, and the mission says that this aborts it. */
	bool aborts() const { return m_aborts; }
	TLegProgress progress() const { return m_guidance.progress(); }
	const TMission& mission() const { return m_mission; }

   private:
	void begin(
		const TControlState& navigation, const Eigen::Vector2d& current, std::vector<TMissionEvent>& events);
	void end(
		EMissionEvent how, const TControlState& navigation, const Eigen::Vector2d& current,
		std::vector<TMissionEvent>& events);

	TMission m_mission;
	CStepGuidance m_guidance;
	size_t m_step{0};
	double m_begun{0}, m_timeout{0};  ///< [s]
	bool m_started{false}, m_aborts{false};
};
}  // namespace posidonia
