#pragma once

#include <posidonia/apps/mission/mission_recorder.h>
#include <posidonia/apps/mission/simulated_vehicle.h>
#include <posidonia/apps/mission/vehicle_computer.h>

#include <functional>

namespace posidonia
{
/** A step of the autopilot, with the truth beside it: a row of control.csv. */
struct TControlStep
{
	double t{0};  ///< From the start [s]
	TVehicleState truth;
	double true_altitude{0};  ///< Of the body's origin over the floor [m]
	TPoseFeedback feedback;	  ///< What the controllers were given
	Eigen::Isometry3d T_odom_body{Eigen::Isometry3d::Identity()};
	TAutopilotOutput output;
	int loops{0};					  ///< ROI edges of the graph so far
	std::vector<std::string> faults;  ///< Names of those that are on
};

/** Simulator -> odometry and SLAM -> guidance and control -> thrusters -> simulator. */
class CClosedLoop
{
   public:
	struct TOptions
	{
		TClosedLoopOptions loop;
		TForcedCorrectionOptions forced;
		double start_time{0};	   ///< Stamp of the beginning [s]
		bool all_pictures{false};  ///< Take every stereo pair, not only those that make nodes
		bool save_depth{false};	   ///< Write the true depths of each pair, too
	};
	CClosedLoop(
		const TOptions& options, CSimulatedVehicle& vehicle, CVehicleComputer& computer,
		CMissionRecorder& recorder);

	struct TListeners
	{
		std::function<void(const TControlStep&)> step;	///< After each step of the autopilot
		std::function<void()> pair;						///< After each stereo pair that SLAM was given
		std::function<bool()> stops;					///< Asked after each step: is that enough?
	};
	/** Until the mission is finished, or it is told to stop. */
	void run(const TListeners& listeners);

	/** CPU stages of the loop itself: rendering, dynamics and sensors, control. */
	mrpt::system::CTimeLogger& timer() { return m_timer; }

   private:
	void sense(const TListeners& listeners);
	bool takes(const CSimulatedVehicle::TMeasurement& measurement);
	void takePair(const CSimulatedVehicle::TMeasurement& pair);
	TControlStep control();
	TControlState chosen(const TPoseFeedback& feedback, const TVehicleState& truth) const;
	void describe(TControlStep& step);
	void forceCorrection(const TVehicleState& truth);

	TOptions m_options;
	CSimulatedVehicle& m_vehicle;
	CVehicleComputer& m_computer;
	CMissionRecorder& m_recorder;
	mrpt::system::CTimeLogger m_timer{true, "closed loop", true};
	long m_steps{0};
	size_t m_edges_counted{0};
	int m_loops{0};
	bool m_forced{false};
};
}  // namespace posidonia
