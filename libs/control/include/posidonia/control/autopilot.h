#pragma once

#include <posidonia/control/allocation.h>
#include <posidonia/control/control_state.h>
#include <posidonia/control/current_observer.h>
#include <posidonia/control/mission.h>
#include <posidonia/control/mission_runner.h>
#include <posidonia/control/pose_controller.h>
#include <posidonia/control/safety_supervisor.h>
#include <posidonia/control/velocity_controller.h>
#include <posidonia/control/velocity_requests.h>

#include <string>
#include <vector>

namespace posidonia
{
/** Every option of the autopilot, by section of the ini. */
struct TAutopilotOptions
{
	TGuidanceOptions guidance;
	TCurrentObserverOptions current_observer;
	TPoseControlOptions pose_control;
	TVelocityControlOptions velocity_control;
	TAllocationOptions allocation;
	TSafetyOptions safety;

	/** f(section name, options struct) for each section. */
	template <class F>
	void forEachSection(F&& f)
	{
		f("Guidance", guidance);
		f("CurrentObserver", current_observer);
		f("PoseControl", pose_control);
		f("VelocityControl", velocity_control);
		f("Allocation", allocation);
		f("Safety", safety);
	}
};

struct TAutopilotOutput
{
	double stamp{0};
	/** Of the thrusters, in [-1, 1]. */
	TThrusters set_points;
	/** What the mission asks for, before saturation and slew limits, and after them. */
	TVelocityCommand unlimited, limited;
	/** Forces asked for and given by the thrusters, body axes. */
	TWrench wanted, achieved;
	/** What guidance steers to now. */
	double heading_reference{0}, depth_reference{0};
	/** Observed current, north east [m/s]. */
	Eigen::Vector2d current{0, 0};
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
	/** The mission should have passed checkMission(). */
	CAutopilot(const TAutopilotOptions& options, const TMission& mission);

	/** One step at health.stamp. `navigation` is the last one known, fresh or not. The mission starts at the
	 * first call with valid navigation. */
	TAutopilotOutput step(const TControlState& navigation, const TVehicleHealth& health);

	const TMission& mission() const { return m_runner.mission(); }

   private:
	void supervise(const TControlState& navigation, const TVehicleHealth& health, TAutopilotOutput& out);
	/** By priority: the mission, what replaces it after an abort, the climb from the floor. */
	void request(const TControlState& navigation, double dt, TAutopilotOutput& out);
	void requestMission(const TControlState& navigation, double dt, TAutopilotOutput& out);
	void requestAbort(double dt, TAutopilotOutput& out);
	void control(const TControlState& navigation, double dt, TAutopilotOutput& out);
	void observeCurrent(const TControlState& navigation, double dt, TAutopilotOutput& out);
	void surfaceBlindly(double now, TAutopilotOutput& out);
	/** Nothing is known for a moment: the thrusters stop. */
	void pause();
	bool finished(const TControlState& navigation, bool fresh) const;

	TAutopilotOptions m_options;
	CMissionRunner m_runner;
	CCurrentObserver m_observer;
	CPoseController m_pose;
	CVelocityController m_velocity;
	CThrusterAllocation m_allocation;
	CSafetySupervisor m_supervisor;
	CVelocityRequests m_requests;
	TSafetyDecision m_decision;
	TVelocityCommand m_acceleration;  ///< Of the mission's references, fed forward
	double m_stamp{-1};				  ///< Of the last step, negative before [s]
	double m_emergency_since{-1};	  ///< [s]
};
}  // namespace posidonia
