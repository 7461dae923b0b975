#include <posidonia/base/error.h>
#include <posidonia/sim/vehicle_dynamics.h>

#include <cmath>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
constexpr double kMicrosecond = 1e-6;
}

CVehicleDynamics::CVehicleDynamics(
	const TVehicleOptions& vehicle, const TThrusterOptions& thrusters, const TCurrentOptions& current,
	double floor_depth, uint64_t seed, const Isometry3d& T_map_body)
	: m_hull(vehicle, floor_depth),
	  m_thrusters(thrusters),
	  m_current(current, vehicle.step, seed),
	  m_step(vehicle.step),
	  m_motion{T_map_body, Vector6d::Zero(), Vector3d::Zero()}
{
	for (const double lag : thrusters.time_constant)
		if (lag < m_step)
			throw CError(
				"[Thrusters] time_constant", "is below the step of the integration",
				"choose it above [Vehicle] step");
}

void CVehicleDynamics::setVelocity(const Vector3d& v_body, const Vector3d& omega_body)
{
	m_motion.nu << v_body, omega_body;
}

void CVehicleDynamics::setSetPoints(const Vector3d& set_points)
{
	m_thrusters.setSetPoints(time(), set_points);
}

CVehicleDynamics::TMotion CVehicleDynamics::moved(const TMotion& from, const step_t& step)
{
	TMotion to = from;
	to.T_map_body.translation() += step.head<3>();
	to.T_map_body.linear() = from.T_map_body.linear() * expSO3(step.segment<3>(3));
	to.nu += step.segment<6>(6);
	to.thrusts += step.tail<3>();
	return to;
}

/** d step / dt at time t, `step` away from the motion at time(). */
CVehicleDynamics::step_t CVehicleDynamics::rate(double t, const step_t& step) const
{
	const TMotion now = moved(m_motion, step);
	const TWaterMotion water = m_current.at(t, now.T_map_body.translation().z());
	const Vector6d nu_r = CHull::relativeVelocity(now.T_map_body, now.nu, water);
	step_t d;
	d << now.T_map_body.linear() * now.nu.head<3>(),
		rightJacobianInverseSO3(step.segment<3>(3)) * now.nu.tail<3>(),
		m_hull.acceleration(now.T_map_body, now.nu, water, m_thrusters.wrench(now.thrusts)),
		m_thrusters.thrustRate(t, now.thrusts, nu_r);
	return d;
}

/** One step of Runge and Kutta from time(). */
CVehicleDynamics::TMotion CVehicleDynamics::integrated(double h) const
{
	const double t = time();
	const step_t k1 = rate(t, step_t::Zero());
	const step_t k2 = rate(t + h / 2, h / 2 * k1);
	const step_t k3 = rate(t + h / 2, h / 2 * k2);
	const step_t k4 = rate(t + h, h * k3);
	return moved(m_motion, h / 6 * (k1 + 2 * k2 + 2 * k3 + k4));
}

void CVehicleDynamics::advanceTo(double t)
{
	while (static_cast<double>(m_steps + 1) * m_step <= t + kMicrosecond) {
		m_motion = integrated(m_step);
		m_motion.T_map_body = orthonormalized(m_motion.T_map_body);
		m_current.advance();
		m_steps++;
	}
	if (!m_motion.nu.allFinite())
		throw CError(
			"[Vehicle] step", "the integration has left the finite before t = " + std::to_string(time()),
			"choose a smaller step, or less stiff damping and floor");
}

TVehicleState CVehicleDynamics::stateAt(double t) const
{
	const double since = t - time();
	if (!(since >= -kMicrosecond && since <= m_step + kMicrosecond))
		throw CError(
			"CVehicleDynamics::stateAt(" + std::to_string(t) + ")",
			"is not within a step of " + std::to_string(time()), "call advanceTo() first");
	const TMotion now = integrated(since);
	const TWaterMotion water = m_current.at(t, now.T_map_body.translation().z());
	const Vector6d nu_rate =
		m_hull.acceleration(now.T_map_body, now.nu, water, m_thrusters.wrench(now.thrusts));
	TVehicleState state;
	state.t = t;
	state.T_map_body = now.T_map_body;
	state.v_body = now.nu.head<3>();
	state.omega_body = now.nu.tail<3>();
	state.v_map = now.T_map_body.linear() * state.v_body;
	state.a_map = now.T_map_body.linear() * (nu_rate.head<3>() + state.omega_body.cross(state.v_body));
	state.alpha_body = nu_rate.tail<3>();
	return state;
}

Vector3d CVehicleDynamics::waterVelocity() const
{
	return m_current.at(time(), m_motion.T_map_body.translation().z()).velocity;
}
}  // namespace posidonia
