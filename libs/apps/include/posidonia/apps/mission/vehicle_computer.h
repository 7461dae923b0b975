#pragma once

#include <posidonia/apps/mission/closed_loop_options.h>
#include <posidonia/control/autopilot.h>
#include <posidonia/control/delayed_corrections.h>
#include <posidonia/control/safe_correction.h>
#include <posidonia/graphslam/node_distance.h>
#include <posidonia/graphslam/stereo_slam.h>

namespace posidonia
{
class CObservationDVL;

/** What the controllers' pose is made of. */
struct TPoseFeedback
{
	TControlState navigation;
	/** The map's own pose at this moment, as SLAM (delayed by the latency) has it. */
	Eigen::Isometry3d T_map_body{Eigen::Isometry3d::Identity()};
	bool correcting{false};
};

/** What runs aboard: odometry and SLAM, the controller-safe pose, the autopilot. It knows what was measured,
 * nothing else. */
class CVehicleComputer
{
   public:
	struct TOptions
	{
		TAutopilotOptions autopilot;
		TControllerPoseOptions controller_pose;
		double latency{0.5}, endurance{8 * 3600};  ///< [s]
		bool uses_slam{true};					   ///< Else the controllers get the odometry
	};
	/** `slam` must outlive it. @param node_distance of its node decider [m] @param start stamp [s] */
	CVehicleComputer(
		const TOptions& options, const TMission& mission, CStereoSlam& slam, double node_distance,
		double start);

	/** Every observation, in order of arrival. */
	void add(const mrpt::obs::CObservation::Ptr& observation);
	/** Would a stereo pair at this moment make a node? To be asked at each pair, before it is taken. */
	bool wantsPair();
	/** From now on the map is believed to be elsewhere by `T` (in map axes, left of T_map_odom). */
	void forceCorrection(const Eigen::Isometry3d& T) { m_forced = T * m_forced; }

	/** The controllers' pose at `stamp`, not before that of the last call. */
	TPoseFeedback feedback(double stamp);
	/** A step of the autopilot by a state that is feedback().navigation, or another one put in its place. */
	TAutopilotOutput step(const TControlState& navigation);

	const CStereoSlam& slam() const { return m_slam; }

   private:
	void noteArrival(const mrpt::obs::CObservation& observation);
	std::optional<double> altitudeOfBody(const CObservationDVL& dvl) const;
	TVehicleHealth health(double stamp) const;

	TOptions m_options;
	double m_node_distance;
	CStereoSlam& m_slam;
	CAutopilot m_autopilot;
	CDelayedCorrections m_corrections;
	CSafeCorrection m_safe;
	TCorrection m_map;	///< The newest that has become visible
	Eigen::Isometry3d m_forced{Eigen::Isometry3d::Identity()};
	double m_start;
	/** Stamps of the last of each kind [s]. */
	struct TArrivals
	{
		double navigation, imu, dvl, good_dvl, depth, altitude, position;
	};
	TArrivals m_last;
	double m_ready_since{-1};
	bool m_has_position{false};	 ///< A vehicle that never got a fix has no GPS
	std::optional<double> m_altitude;
	CNodeDistance m_distance;
};
}  // namespace posidonia
