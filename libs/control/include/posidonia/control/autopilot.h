#pragma once

#include <posidonia/control/allocation.h>
#include <posidonia/control/guidance.h>
#include <posidonia/control/mission.h>
#include <posidonia/control/navigation_state.h>
#include <posidonia/control/pose_controller.h>
#include <posidonia/control/safety_supervisor.h>
#include <posidonia/control/velocity_controller.h>

#include <memory>
#include <string>
#include <vector>

namespace posidonia
{
/** Every option of the autopilot, by section of the ini. */
struct TAutopilotOptions
{
	TGuidanceOptions guidance;
	TPoseControlOptions pose_control;
	TVelocityControlOptions velocity_control;
	TAllocationOptions allocation;
	TSafetyOptions safety;

	/** f(section name, options struct) for each section. */
	template <class F>
	void forEachSection(F&& f)
	{
		f("Guidance", guidance);
		f("PoseControl", pose_control);
		f("VelocityControl", velocity_control);
		f("Allocation", allocation);
		f("Safety", safety);
	}
};

enum class EMissionEvent
{
	STEP_STARTED,
	STEP_REACHED,
	STEP_TIMED_OUT,
	MISSION_DONE,
	MISSION_ABORTED,
	SAFETY_LEVEL
};
std::string toString(EMissionEvent kind);

struct TMissionEvent
{
	double stamp{0};  ///< [s]
	EMissionEvent kind{EMissionEvent::STEP_STARTED};
	std::string text;
};

struct TAutopilotOutput
{
	double stamp{0};
	/** Of the thrusters, in [-1, 1]. */
	double starboard{0}, port{0}, heave{0};
	/** What the mission asks for, before saturation and slew limits, and after them. */
	TVelocityCommand unlimited, limited;
	/** Forces asked for and given by the thrusters, body axes. */
	TWrench wanted, achieved;
	/** What guidance steers to now. */
	double heading_reference{0}, depth_reference{0};
	/** Step that is being done; index into the mission's steps, size() when done. */
	size_t step{0};
	TLegProgress leg;
	ESafetyLevel level{ESafetyLevel::NONE};
	bool drop_weight{false};
	/** What happened in this step, in order. */
	std::vector<TMissionEvent> events;
	/** The mission is done, or aborted and the vehicle is where the abort brings it. */
	bool finished{false};
};

/** Mission, guidance, controllers, allocation and supervisor as one: state in, set-points out, at 10 Hz. */
class CAutopilot
{
   public:
	/** Throws CError for options that do not fit together. The mission should have passed checkMission(). */
	CAutopilot(const TAutopilotOptions& options, const TMission& mission);
	~CAutopilot();

	/** One step at health.stamp. `navigation` is the last one known, fresh or not. The mission starts at the
	 * first call with valid navigation. */
	TAutopilotOutput step(const TNavigationState& navigation, const TVehicleHealth& health);

	const TMission& mission() const;

   private:
	class CImpl;
	std::unique_ptr<CImpl> m_impl;
};
}  // namespace posidonia
