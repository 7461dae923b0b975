#include <posidonia/base/error.h>
#include <posidonia/sim/thrusters.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
using Eigen::Vector3d;

namespace
{
Vector6d unitWrench(const Vector3d& axis, const std::vector<double>& position)
{
	const Vector3d at(position[0], position[1], position[2]);
	Vector6d wrench;
	wrench << axis, at.cross(axis);
	return wrench;
}
}  // namespace

CThrusters::CThrusters(const TThrusterOptions& o) : m_options(o)
{
	const Vector3d ahead = Vector3d::UnitX(), down = Vector3d::UnitZ();
	m_configuration << unitWrench(ahead, o.starboard_position), unitWrench(ahead, o.port_position),
		unitWrench(down, o.heave_position);
}

void CThrusters::setSetPoints(double t, const Vector3d& wanted)
{
	if (!wanted.allFinite())
		throw CError("thruster set-points", "one is not a number", "give starboard, port, heave, -1 to 1");
	m_before = setPointsAt(t);
	m_wanted = wanted.cwiseMax(-1).cwiseMin(1);
	m_since = t;
}

Vector3d CThrusters::setPointsAt(double t) const
{
	const double reach = m_options.slew_rate * std::max(0.0, t - m_since);
	return m_before + (m_wanted - m_before).cwiseMax(-reach).cwiseMin(reach);
}

double CThrusters::steadyThrust(int i, double s, double inflow) const
{
	if (std::abs(s) < m_options.dead_band) return 0;
	const double greatest = s > 0 ? m_options.max_forward[i] : m_options.max_reverse[i];
	const double u_0 = m_options.zero_thrust_speed;
	return m_efficiency[i] * greatest * std::abs(s) * (s - (u_0 > 0 ? inflow / u_0 : 0));
}

Vector3d CThrusters::thrustRate(double t, const Vector3d& thrusts, const Vector6d& nu_r) const
{
	const Vector3d s = setPointsAt(t);
	const Vector3d inflow = m_configuration.transpose() * nu_r;	 // of the water along each thrust
	Vector3d rate;
	for (int i = 0; i < 3; i++)
		rate[i] = (steadyThrust(i, s[i], inflow[i]) - thrusts[i]) / m_options.time_constant[i];
	return rate;
}
}  // namespace posidonia
