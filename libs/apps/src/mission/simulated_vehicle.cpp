#include <posidonia/apps/mission/simulated_vehicle.h>

#include <mrpt/obs/CObservationStereoImages.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
Isometry3d startPose(const TRouteOptions& route)
{
	Isometry3d T = Isometry3d::Identity();
	T.translation() = Vector3d(route.start[0], route.start[1], route.start[2]);
	T.linear() = rotationFromYawPitchRoll(route.start[3] * M_PI / 180, 0, 0);
	return T;
}
}  // namespace

CSimulatedVehicle::CSimulatedVehicle(
	const TSimulationOptions& o, const TSensorSuite& nominal, const std::vector<TFaultOptions>& faults)
	: m_scene(o, nominal),
	  m_bank(o, nominal, m_scene.floor()),
	  m_faults(faults, nominal, o.run.seed),
	  m_dynamics(o.vehicle, o.thrusters, o.current, o.floor.depth, o.run.seed, startPose(o.route))
{
}

TVehicleState CSimulatedVehicle::moveTo(double t)
{
	m_dynamics.setEfficiency(m_faults.thrusterEfficiency(t));
	m_dynamics.setAddedCurrent(m_faults.current(t));
	m_dynamics.advanceTo(t);
	return m_dynamics.stateAt(t);
}

CSimulatedVehicle::TMeasurement CSimulatedVehicle::measure()
{
	TMeasurement m;
	m.truth = moveTo(m_bank.nextTime());
	m.observation = m_bank.measure(m.truth);
	if (!m.observation) return m;
	if (IS_CLASS(*m.observation, mrpt::obs::CObservationStereoImages)) m.frame = m_frame++;
	m.observation = m_faults.apply(m.observation, m.truth.t);
	return m;
}

/** The state goes on for as long as the camera's clock is off: hundredths of a second. */
Isometry3d CSimulatedVehicle::poseOfExposure(const TMeasurement& pair) const
{
	const double late = m_scene.cameraClock();
	Isometry3d T_map_body = pair.truth.T_map_body;
	T_map_body.translation() += late * pair.truth.v_map;
	T_map_body.linear() *= expSO3(late * pair.truth.omega_body);
	return T_map_body;
}

TGreyPair CSimulatedVehicle::photograph(const TMeasurement& pair) const
{
	TGreyPair pictures = m_scene.photograph(
		TExposure{
			poseOfExposure(pair), pair.truth.v_body, pair.truth.omega_body, m_faults.turbidity(pair.truth.t)},
		pair.frame.value());
	if (m_faults.blackout(pair.truth.t)) {
		pictures.left.setTo(0);
		pictures.right.setTo(0);
	}
	return pictures;
}
}  // namespace posidonia
