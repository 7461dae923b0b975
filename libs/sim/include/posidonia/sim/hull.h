#pragma once

#include <posidonia/base/options.h>
#include <posidonia/geometry/se3.h>

namespace posidonia
{
/** Section [Vehicle]: the hull. Six numbers go surge, sway, heave, roll, pitch, yaw; points are in body axes,
 * forward, starboard, down. Toulon: the course's models of SPARUS II (Elkholy2021/marine_modeling_sparus_II,
 * eather0056/...-Sparus-AUV: Parameters.m, Added_Mass_and_Drag_Matrix.mlx). Nobody has published measured
 * damping. */
struct TVehicleOptions
{
	double mass{52}, buoyancy_mass{52.1};
	std::vector<double> centre_of_gravity{0, 0, 0}, centre_of_buoyancy{0, 0, -0.02};
	std::vector<double> inertia{0.42, 10.42, 10.47};
	double inertia_xz{0.03};
	std::vector<double> added_mass{2.1, 70.4, 69.2, 0.42, 16.2, 16.2};
	double added_mass_sway_yaw{-1.95}, added_mass_heave_pitch{1.57};
	std::vector<double> linear_damping{8, 30, 30, 1, 5, 5};
	std::vector<double> quadratic_damping{36, 96, 89, 0.1, 15, 15};
	double stern_lift{50}, stern_position{-0.573};
	double hull_length{1.6}, hull_radius{0.115};
	double floor_stiffness{2e4};
	double step{0.005};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("mass", mass, above(0), "Mass in air [kg] (Toulon)");
		v.number(
			"buoyancy_mass", buoyancy_mass, above(0),
			"Mass of the water that the submerged hull displaces [kg] (Toulon: 0.1 kg more than it weighs)");
		v.numbers(
			"centre_of_gravity", centre_of_gravity, 3, between(-1, 1),
			"From the body's origin [m]; not zero: ballast moved");
		v.numbers(
			"centre_of_buoyancy", centre_of_buoyancy, 3, between(-1, 1),
			"From the body's origin, the middle of the hull's axis [m] (Toulon: 2 cm above the origin)");
		v.numbers("inertia", inertia, 3, above(0), "Ixx Iyy Izz about the body's origin [kg m^2] (Elkholy)");
		v.number(
			"inertia_xz", inertia_xz, anyNumber(), "Product of inertia, sum of x z dm [kg m^2] (Elkholy)");
		v.numbers(
			"added_mass", added_mass, 6, atLeast(0),
			"Of the water moved along [kg], [kg m^2] (Toulon's total less the rigid body)");
		v.number(
			"added_mass_sway_yaw", added_mass_sway_yaw, anyNumber(),
			"Its entry (2, 6) [kg m]: aft appendages make it negative (Toulon)");
		v.number(
			"added_mass_heave_pitch", added_mass_heave_pitch, anyNumber(),
			"Its entry (3, 5) [kg m]: aft appendages make it positive (Toulon)");
		v.numbers(
			"linear_damping", linear_damping, 6, atLeast(0),
			"[N s/m], [N m s] (an assumption: the Toulon models have none)");
		v.numbers(
			"quadratic_damping", quadratic_damping, 6, atLeast(0),
			"[N s^2/m^2], [N m s^2] (Toulon's hull, antenna and pods; pitch and yaw by strips: 12 to 25)");
		v.number(
			"stern_lift", stern_lift, atLeast(0),
			"Lift of the thruster pods and the afterbody, 1/2 rho S dC_L/d alpha [N s^2/m^2]");
		v.number("stern_position", stern_position, between(-10, 10), "Where it acts, along the hull [m]");
		v.number("hull_length", hull_length, above(0), "[m] (Toulon)");
		v.number("hull_radius", hull_radius, above(0), "[m] (Toulon)");
		v.number(
			"floor_stiffness", floor_stiffness, between(0, 1e6),
			"Push of the sea floor on a hull end that touches it [N/m] (an assumption)");
		v.number("step", step, between(1e-4, 0.05), "Step of the integration [s]");
	}
};

/** C(nu) nu of a symmetric mass matrix (Kirchhoff's equations, Fossen 2011, eq. 3.46): with the momenta
 * (P, H) = M nu it is (omega x P, omega x H + v x P); nu' C nu = 0. */
Vector6d coriolisForce(const Matrix6d& M, const Vector6d& nu);

/** Part of a circle of `radius` below the surface, 0 to 1, when its centre is at `depth` [m]: the area of a
 * circular segment. */
double submergedPart(double depth, double radius);

/** The water about the hull, map axes. */
struct TWaterMotion
{
	Eigen::Vector3d velocity{0, 0, 0};		///< [m/s]
	Eigen::Vector3d acceleration{0, 0, 0};	///< Of the water itself [m/s^2]
	Eigen::Vector3d shear{0, 0, 0};			///< d velocity / d depth [1/s]
};

/** A rigid hull in moving water, six degrees of freedom (Fossen 2011, Handbook of Marine Craft Hydrodynamics
 * and Motion Control, eq. 6.42 and 8.1). Velocities nu = (v, omega) and wrenches (force, moment about the
 * body's origin) in body axes. */
class CHull
{
   public:
	/** `floor_depth` [m], infinite: no floor. Throws CError, with section and key, where no body has such
	 * masses or where it would float upside down. */
	CHull(const TVehicleOptions& options, double floor_depth);

	const Matrix6d& rigidBodyMass() const { return m_rigid_mass; }
	const Matrix6d& addedMass() const { return m_added_mass; }

	/** nu relative to the water. */
	static Vector6d relativeVelocity(
		const Eigen::Isometry3d& T_map_body, const Vector6d& nu, const TWaterMotion& water);
	/** d nu / dt under the wrench `tau` of the thrusters. */
	Vector6d acceleration(
		const Eigen::Isometry3d& T_map_body, const Vector6d& nu, const TWaterMotion& water,
		const Vector6d& tau) const;

   private:
	/** Points on the hull's axis, each with the buoyancy of its slice. */
	static constexpr int kSlices = 8;
	Vector6d damping(const Vector6d& nu_r) const;
	Vector6d sternLift(const Vector6d& nu_r) const;
	Vector6d weight(const Eigen::Isometry3d& T_map_body) const;
	Vector6d buoyancy(const Eigen::Isometry3d& T_map_body, const Eigen::Vector3d& water_acceleration) const;
	Vector6d floorContact(const Eigen::Isometry3d& T_map_body, const Vector6d& nu) const;
	Eigen::Vector3d onAxis(double ahead) const;

	Matrix6d m_rigid_mass, m_added_mass, m_inverse_mass;
	Vector6d m_linear_damping, m_quadratic_damping;
	double m_mass, m_buoyancy_mass;
	Eigen::Vector3d m_gravity_centre, m_buoyancy_centre;
	double m_stern_lift, m_length, m_radius;
	Eigen::Vector3d m_stern;
	double m_floor_depth, m_floor_stiffness;
};
}  // namespace posidonia
