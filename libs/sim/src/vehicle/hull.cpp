#include <posidonia/base/error.h>
#include <posidonia/obs/frames.h>
#include <posidonia/sim/hull.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
/** The dissipation of Hunt and Crossley (1975) [s/m]: what touches at 0.1 m/s goes back with 0.88 of its
 * speed, at 0.5 m/s with 0.6. */
constexpr double kFloorDissipation = 2;

Vector6d sixNumbers(const std::vector<double>& numbers)
{
	return Eigen::Map<const Vector6d>(numbers.data());
}
Vector3d point(const std::vector<double>& numbers)
{
	return Eigen::Map<const Vector3d>(numbers.data());
}

/** The wrench of a force that acts at a point, body axes. */
Vector6d wrenchOf(const Vector3d& force, const Vector3d& at)
{
	Vector6d wrench;
	wrench << force, at.cross(force);
	return wrench;
}

/** Fossen 2011, eq. 3.44. */
Matrix6d rigidBodyMassOf(const TVehicleOptions& o)
{
	const Matrix3d S = skew(point(o.centre_of_gravity));
	Matrix6d M;
	M << o.mass * Matrix3d::Identity(), -o.mass * S, o.mass * S, Matrix3d(point(o.inertia).asDiagonal());
	M(3, 5) = M(5, 3) = -o.inertia_xz;
	return M;
}

Matrix6d addedMassOf(const TVehicleOptions& o)
{
	Matrix6d M = sixNumbers(o.added_mass).asDiagonal();
	M(1, 5) = M(5, 1) = o.added_mass_sway_yaw;
	M(2, 4) = M(4, 2) = o.added_mass_heave_pitch;
	return M;
}

void refuseNonsense(const TVehicleOptions& o)
{
	if (!isPositiveDefinite(rigidBodyMassOf(o)))
		throw CError(
			"[Vehicle] inertia", "no rigid body has it with this mass, centre_of_gravity and inertia_xz",
			"the mass matrix must be positive definite");
	if (!isPositiveDefinite(rigidBodyMassOf(o) + addedMassOf(o)))
		throw CError(
			"[Vehicle] added_mass_sway_yaw, added_mass_heave_pitch",
			"the mass matrix with the added mass is not positive definite", "choose them nearer to zero");
	if (o.centre_of_buoyancy[2] >= o.centre_of_gravity[2])
		throw CError(
			"[Vehicle] centre_of_buoyancy", "is not above the centre of gravity: it floats upside down",
			"z points down: choose its third number below that of centre_of_gravity");
}
}  // namespace

Vector6d coriolisForce(const Matrix6d& M, const Vector6d& nu)
{
	const Vector6d momentum = M * nu;
	const Vector3d v = nu.head<3>(), omega = nu.tail<3>();
	const Vector3d P = momentum.head<3>(), H = momentum.tail<3>();
	Vector6d force;
	force << omega.cross(P), omega.cross(H) + v.cross(P);
	return force;
}

double submergedPart(double depth, double radius)
{
	const double x = depth / radius;
	if (x >= 1) return 1;
	if (x <= -1) return 0;
	return 1 - (std::acos(x) - x * std::sqrt(1 - x * x)) / M_PI;
}

CHull::CHull(const TVehicleOptions& o, double floor_depth)
	: m_rigid_mass(rigidBodyMassOf(o)),
	  m_added_mass(addedMassOf(o)),
	  m_linear_damping(sixNumbers(o.linear_damping)),
	  m_quadratic_damping(sixNumbers(o.quadratic_damping)),
	  m_mass(o.mass),
	  m_buoyancy_mass(o.buoyancy_mass),
	  m_gravity_centre(point(o.centre_of_gravity)),
	  m_buoyancy_centre(point(o.centre_of_buoyancy)),
	  m_stern_lift(o.stern_lift),
	  m_length(o.hull_length),
	  m_radius(o.hull_radius),
	  m_stern(o.stern_position, 0, 0),
	  m_floor_depth(floor_depth),
	  m_floor_stiffness(o.floor_stiffness)
{
	refuseNonsense(o);
	m_inverse_mass = (m_rigid_mass + m_added_mass).inverse();
}

Vector6d CHull::relativeVelocity(const Isometry3d& T_map_body, const Vector6d& nu, const TWaterMotion& water)
{
	Vector6d nu_r = nu;
	nu_r.head<3>() -= T_map_body.linear().transpose() * water.velocity;
	return nu_r;
}

/** M_RB nu' + C_RB nu + M_A nu_r' + C_A nu_r + D nu_r = weight + buoyancy + floor + tau, solved for nu' with
 * nu_r' = nu' - nu_c', nu_c' = (R' d v_c/dt - omega x R' v_c, 0), d v_c/dt that along the hull's way. */
Vector6d CHull::acceleration(
	const Isometry3d& T_map_body, const Vector6d& nu, const TWaterMotion& water, const Vector6d& tau) const
{
	const Matrix3d R_body_map = T_map_body.linear().transpose();
	const Vector3d omega = nu.tail<3>();
	const double sink_rate = T_map_body.linear().row(2).dot(nu.head<3>());
	const Vector6d nu_r = relativeVelocity(T_map_body, nu, water);
	Vector6d nu_c_rate = Vector6d::Zero();
	nu_c_rate.head<3>() = R_body_map * (water.acceleration + sink_rate * water.shear) -
						  omega.cross(R_body_map * water.velocity);
	return m_inverse_mass *
		   (tau + weight(T_map_body) + buoyancy(T_map_body, water.acceleration) +
			floorContact(T_map_body, nu) + sternLift(nu_r) - damping(nu_r) - coriolisForce(m_rigid_mass, nu) -
			coriolisForce(m_added_mass, nu_r) + m_added_mass * nu_c_rate);
}

Vector6d CHull::damping(const Vector6d& nu_r) const
{
	return (m_linear_damping + m_quadratic_damping.cwiseProduct(nu_r.cwiseAbs())).cwiseProduct(nu_r);
}

/** Against the sideways flow at the stern, in proportion to the speed ahead: what a body with its lifting
 * area behind the middle holds against the Munk moment of its added mass (Fossen 2011, sec. 6.4). */
Vector6d CHull::sternLift(const Vector6d& nu_r) const
{
	const Vector3d flow = nu_r.head<3>() + nu_r.tail<3>().cross(m_stern);
	const double per_flow = m_stern_lift * std::abs(flow.x());
	return wrenchOf({0, -per_flow * flow.y(), -per_flow * flow.z()}, m_stern);
}

Vector6d CHull::weight(const Isometry3d& T_map_body) const
{
	const Vector3d down = T_map_body.linear().row(2);
	return wrenchOf(m_mass * kGravity * down, m_gravity_centre);
}

/** Of each slice by the part of its circle that is under water, at the slice's centre, against gravity as the
 * (accelerated) water feels it: the pressure gradient carries a body of water along with its surroundings. */
Vector6d CHull::buoyancy(const Isometry3d& T_map_body, const Vector3d& water_acceleration) const
{
	const Vector3d felt_gravity = Vector3d(0, 0, kGravity) - water_acceleration;
	const Vector3d lift = -m_buoyancy_mass * (T_map_body.linear().transpose() * felt_gravity);
	if ((T_map_body * m_buoyancy_centre).z() > m_radius + m_length / 2)
		return wrenchOf(lift, m_buoyancy_centre);
	Vector6d sum = Vector6d::Zero();
	for (int i = 0; i < kSlices; i++) {
		const Vector3d centre = onAxis(m_length * ((i + 0.5) / kSlices - 0.5));
		const double part = submergedPart((T_map_body * centre).z(), m_radius);
		sum += wrenchOf(part / kSlices * lift, centre);
	}
	return sum;
}

/** Each end of the hull is a ball that the floor pushes up, F = k d (1 + c d'), d how deep it digs in
 * (Hunt and Crossley 1975); without friction. */
Vector6d CHull::floorContact(const Isometry3d& T_map_body, const Vector6d& nu) const
{
	const Vector3d down = T_map_body.linear().row(2);
	Vector6d sum = Vector6d::Zero();
	for (const double end : {-m_length / 2, m_length / 2}) {
		const Vector3d centre = onAxis(end);
		const double dug = (T_map_body * centre).z() + m_radius - m_floor_depth;
		if (dug <= 0) continue;
		const double rate = down.dot(nu.head<3>() + nu.tail<3>().cross(centre));
		const double push = m_floor_stiffness * dug * std::max(0.0, 1 + kFloorDissipation * rate);
		sum += wrenchOf(-push * down, centre);
	}
	return sum;
}

Vector3d CHull::onAxis(double ahead) const
{
	return m_buoyancy_centre + Vector3d(ahead, 0, 0);
}
}  // namespace posidonia
