#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <posidonia/apps/mission/vehicle_computer.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/CObservationPressure.h>
#include <posidonia/obs/observations.h>

namespace posidonia
{
using Eigen::Isometry3d;

CVehicleComputer::CVehicleComputer(
	const TOptions& options, const TMission& mission, CStereoSlam& slam, double node_distance, double start)
	: m_options(options),
	  m_node_distance(node_distance),
	  m_slam(slam),
	  m_autopilot(options.autopilot, mission),
	  m_corrections(options.latency),
	  m_safe(options.controller_pose),
	  m_start(start),
	  m_last{start, start, start, start, start, start, start}
{
}

void CVehicleComputer::add(const mrpt::obs::CObservation::Ptr& observation)
{
	m_slam.add(observation);
	noteArrival(*observation);
	if (!m_slam.addedNode()) return;
	const TCausalPose now = m_slam.now();
	m_corrections.push({now.stamp, now.T_map_body * now.T_odom_body.inverse(), m_slam.covariance()});
}

void CVehicleComputer::noteArrival(const mrpt::obs::CObservation& o)
{
	const double stamp = stampOf(o);
	if (m_slam.odometry().ready()) {
		if (m_ready_since < 0) m_ready_since = stamp;
		m_last.navigation = m_slam.odometry().stamp();
	}
	if (const auto* dvl = dynamic_cast<const CObservationDVL*>(&o)) {
		m_last.dvl = stamp;
		if (dvl->velocity_valid) m_last.good_dvl = stamp;
		m_altitude = altitudeOfBody(*dvl);
		if (m_altitude) m_last.altitude = stamp;
	}
	else if (dynamic_cast<const CObservationPressure*>(&o))
		m_last.depth = stamp;
	else if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&o); imu && imuReadingOf(*imu))
		m_last.imu = stamp;
	else if (dynamic_cast<const mrpt::obs::CObservationGPS*>(&o))
		m_last.position = stamp, m_has_position = true;
}

/** The instrument is lower than the body's origin. */
std::optional<double> CVehicleComputer::altitudeOfBody(const CObservationDVL& dvl) const
{
	if (!dvl.altitude_valid || !m_slam.odometry().ready()) return std::nullopt;
	const Eigen::Vector3d lever(dvl.sensorPose.x(), dvl.sensorPose.y(), dvl.sensorPose.z());
	return dvl.altitude + (m_slam.odometry().now().T.linear() * lever).z();
}

/** As CDistanceNRD decides. */
bool CVehicleComputer::wantsPair()
{
	if (!m_slam.odometry().ready()) return false;
	if (m_slam.map().nodeCount() == 0) return true;
	return m_distance.reached(m_slam.odometry().sinceClone().T.translation().norm(), m_node_distance);
}

TPoseFeedback CVehicleComputer::feedback(double stamp)
{
	TPoseFeedback out;
	out.navigation.stamp = stamp;
	if (!m_slam.odometry().ready()) return out;
	const TPoseEstimate odometry = m_slam.odometry().now();
	if (const auto correction = m_corrections.takeVisible(stamp)) m_map = *correction;
	const Isometry3d T_map_odom = m_options.uses_slam ? m_forced * m_map.T_map_odom : m_forced;
	m_safe.setTarget(T_map_odom);
	m_safe.advance(stamp, odometry.T);
	out.T_map_body = T_map_odom * odometry.T;
	out.correcting = m_safe.correcting();
	const TBodyMotion motion = m_slam.odometry().motion();
	out.navigation.T_map_body = m_safe.T_map_body();
	out.navigation.v_body = motion.velocity;
	out.navigation.omega_body = motion.rate;
	out.navigation.altitude = m_altitude;
	out.navigation.valid = true;
	out.navigation.cov = m_safe.covariance(m_options.uses_slam ? m_map.cov : odometry.cov);
	return out;
}

TAutopilotOutput CVehicleComputer::step(const TControlState& navigation)
{
	return m_autopilot.step(navigation, health(navigation.stamp));
}

TVehicleHealth CVehicleComputer::health(double stamp) const
{
	TVehicleHealth health;
	health.stamp = stamp;
	health.navigation_age = m_ready_since < 0 ? 0 : stamp - m_last.navigation;
	health.imu_age = stamp - m_last.imu;
	health.dvl_age = stamp - m_last.dvl;
	health.good_dvl_age = stamp - m_last.good_dvl;
	health.depth_age = stamp - m_last.depth;
	health.altitude_age = stamp - m_last.altitude;
	health.position_age = m_has_position ? stamp - m_last.position : 0;
	health.initialised_for = m_ready_since < 0 ? 0 : stamp - m_ready_since;
	health.mission_time = stamp - m_start;
	health.battery = std::max(0.0, 1 - health.mission_time / m_options.endurance);
	return health;
}
}  // namespace posidonia
