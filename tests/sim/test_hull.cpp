#include <posidonia/obs/frames.h>

#include <random>

#include "numerical_derivative.h"
#include "random_pose.h"
#include "vehicle_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
Vector6d randomVelocity(std::mt19937& rng, double speed = 1, double rate = 1)
{
	Vector6d nu;
	nu.head<3>() = randomVector(rng, speed);
	nu.tail<3>() = randomVector(rng, rate);
	return nu;
}
TVehicleOptions ballastMoved()
{
	TVehicleOptions o;
	o.centre_of_gravity = {0.1, 0.02, 0.03};
	return o;
}
/** The wrench that makes this acceleration at rest. */
Vector6d wrenchAtRest(const CHull& hull, const Isometry3d& T_map_body)
{
	return (hull.rigidBodyMass() + hull.addedMass()) *
		   hull.acceleration(T_map_body, Vector6d::Zero(), {}, Vector6d::Zero());
}
/** Greatest real part of the eigenvalues of small motions about a straight course at speed u; `sideways` and
 * `turning` are the plane's entries of nu, `restoring` tells whether gravity rights the turn. */
double growth(const CHull& hull, double u, int sideways, int turning, bool restoring)
{
	const auto motion = [&](const Eigen::VectorXd& x) {
		Vector6d nu = Vector6d::Zero();
		nu[0] = u, nu[sideways] = x[0], nu[turning] = x[1];
		Isometry3d T = poseAt(50);
		if (restoring) T.linear() = rotationFromYawPitchRoll(0, x[2], 0);
		const Vector6d rate = hull.acceleration(T, nu, {}, Vector6d::Zero());
		return Eigen::VectorXd(Vector3d(rate[sideways], rate[turning], restoring ? x[1] : -x[2]));
	};
	return numericalDerivative(motion, 3).eigenvalues().real().maxCoeff();
}
double greatestGrowth(const TVehicleOptions& options, double u)
{
	const CHull hull(options, kNoFloor);
	return std::max(growth(hull, u, 2, 4, true), growth(hull, u, 1, 5, false));
}
}  // namespace

TEST(Hull, MassMatricesAreSymmetricAndPositive)
{
	for (const auto& options : {TVehicleOptions(), ballastMoved()}) {
		const CHull hull(options, kNoFloor);
		EXPECT_TRUE(isPositiveDefinite(hull.rigidBodyMass()));
		EXPECT_TRUE(isPositiveDefinite(hull.rigidBodyMass() + hull.addedMass()));
		EXPECT_EQ(hull.rigidBodyMass(), Matrix6d(hull.rigidBodyMass().transpose()));
		EXPECT_EQ(hull.addedMass(), Matrix6d(hull.addedMass().transpose()));
	}
}

/** Water held by something at the stern, x ahead, moves with the speed there: v + x r and w - x q. */
TEST(Hull, SternsWaterCouplesSwayWithYawAndHeaveWithPitch)
{
	const double x = -0.6, held = 5;
	TVehicleOptions with, without;
	without.added_mass_sway_yaw = without.added_mass_heave_pitch = 0;
	with.added_mass_sway_yaw = held * x, with.added_mass_heave_pitch = -held * x;
	for (const int i : {1, 2})
		with.added_mass[i] += held, with.added_mass[i + 3] += held * x * x;	 // sway, heave; pitch, yaw
	std::mt19937 rng(5);
	const Matrix6d more = CHull(with, kNoFloor).addedMass() - CHull(without, kNoFloor).addedMass();
	for (int i = 0; i < 10; i++) {
		const Vector6d nu = randomVelocity(rng);
		const double sway = nu[1] + x * nu[5], heave = nu[2] - x * nu[4];
		EXPECT_NEAR(nu.dot(more * nu), held * (sway * sway + heave * heave), 1e-9) << i;
	}
}

/** Kinetic energy of a cloud of points is nu' M nu / 2: an own way to the matrix. */
TEST(Hull, RigidBodyMassIsThatOfItsPoints)
{
	std::mt19937 rng(3);
	TVehicleOptions o;
	std::vector<Vector3d> points;
	for (int i = 0; i < 20; i++)
		points.push_back(randomVector(rng, 0.5) + Vector3d(0.1, 0, 0.2));
	const double each = o.mass / 20;
	Vector3d centre(0, 0, 0);
	Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
	for (const Vector3d& p : points) {
		centre += p / 20;
		inertia += each * skew(p).transpose() * skew(p);
	}
	// The options know no Ixy and Iyz: the cloud and its mirror image in the middle plane have none.
	o.centre_of_gravity = {centre.x(), 0, centre.z()};
	o.centre_of_buoyancy = {0, 0, -0.5};
	o.inertia = {inertia(0, 0), inertia(1, 1), inertia(2, 2)};
	o.inertia_xz = -inertia(0, 2);
	const CHull hull(o, kNoFloor);
	for (int i = 0; i < 10; i++) {
		const Vector6d nu = randomVelocity(rng);
		double energy = 0;
		for (const Vector3d& p : points)
			for (const double side : {1.0, -1.0}) {
				const Vector3d at(p.x(), side * p.y(), p.z());
				energy += each / 2 * (nu.head<3>() + nu.tail<3>().cross(at)).squaredNorm() / 2;
			}
		EXPECT_NEAR(nu.dot(hull.rigidBodyMass() * nu) / 2, energy, 1e-9) << i;
	}
}

/** Fossen 2011, eq. 3.46, written as a matrix. */
TEST(Hull, CoriolisMatrixIsSkewAndDoesNoWork)
{
	std::mt19937 rng(1);
	for (int i = 0; i < 50; i++) {
		const Matrix6d M = randomCovariance(rng, 3);
		const Vector6d nu = randomVelocity(rng);
		const Vector6d p = M * nu;
		Matrix6d C = Matrix6d::Zero();
		C.topRightCorner<3, 3>() = C.bottomLeftCorner<3, 3>() = -skew(p.head<3>());
		C.bottomRightCorner<3, 3>() = -skew(p.tail<3>());
		EXPECT_LT((C + C.transpose()).norm(), 1e-12) << i;
		EXPECT_LT((coriolisForce(M, nu) - C * nu).norm(), 1e-10) << i;
		EXPECT_NEAR(nu.dot(coriolisForce(M, nu)), 0, 1e-10) << i;
	}
}

TEST(Hull, SubmergedPartIsTheAreaOfTheSegment)
{
	const double radius = 0.115;
	EXPECT_EQ(submergedPart(-radius, radius), 0);
	EXPECT_EQ(submergedPart(-1, radius), 0);
	EXPECT_NEAR(submergedPart(0, radius), 0.5, 1e-15);
	EXPECT_EQ(submergedPart(radius, radius), 1);
	EXPECT_EQ(submergedPart(9, radius), 1);
	for (double depth = -0.11; depth < 0.11; depth += 0.02) {
		// The area grows by the width of the water line, 2 sqrt(r^2 - depth^2).
		const double slope =
			(submergedPart(depth + 1e-6, radius) - submergedPart(depth - 1e-6, radius)) / 2e-6;
		const double width = 2 * std::sqrt(radius * radius - depth * depth);
		EXPECT_NEAR(slope, width / (M_PI * radius * radius), 1e-6) << depth;
	}
}

TEST(Hull, IsRightedByItsCentreOfBuoyancy)
{
	const TVehicleOptions o;
	const CHull hull(o, kNoFloor);
	for (const double angle : {-2.0, -0.3, 0.1, 1.2}) {
		Isometry3d rolled = poseAt(20), pitched = poseAt(20);
		rolled.linear() = rotationFromYawPitchRoll(0.4, 0, angle);
		pitched.linear() = rotationFromYawPitchRoll(0.4, angle / 2, 0);
		const double stiffness = o.buoyancy_mass * kGravity * 0.02;
		EXPECT_NEAR(wrenchAtRest(hull, rolled)[3], -stiffness * std::sin(angle), 1e-9) << angle;
		EXPECT_NEAR(wrenchAtRest(hull, pitched)[4], -stiffness * std::sin(angle / 2), 1e-9) << angle;
	}
	const Vector6d level = wrenchAtRest(hull, poseAt(20));
	EXPECT_NEAR(level[2], -0.1 * kGravity, 1e-9) << "the 0.1 kg of buoyancy";
}

TEST(Hull, BuoyancyFallsAsItLeavesTheWater)
{
	const TVehicleOptions o;
	const CHull hull(o, kNoFloor);
	for (double depth = -0.2; depth < 0.3; depth += 0.05) {
		const double lift = o.mass * kGravity - wrenchAtRest(hull, poseAt(depth))[2];
		const double expected =
			o.buoyancy_mass * kGravity * submergedPart(depth + o.centre_of_buoyancy[2], o.hull_radius);
		EXPECT_NEAR(lift, expected, 1e-9) << depth;
	}
}

TEST(Hull, WaterThatSpeedsUpTakesAWeightlessHullAlong)
{
	TVehicleOptions o;
	o.buoyancy_mass = o.mass;
	o.centre_of_buoyancy = {0, 0, -1e-9};
	TWaterMotion water;
	water.acceleration = {0.3, -0.2, 0.1};
	const Vector6d rate =
		CHull(o, kNoFloor).acceleration(poseAt(20), Vector6d::Zero(), water, Vector6d::Zero());
	EXPECT_LT((rate.head<3>() - water.acceleration).norm(), 1e-7);
	EXPECT_LT(rate.tail<3>().norm(), 1e-6);
}

TEST(Hull, ShearIsFeltAsTheWaterChangesAlongTheWay)
{
	const CHull hull(idealFluid(), kNoFloor);
	TWaterMotion water;
	water.shear = {0, 0.1, 0};
	Vector6d sinking = Vector6d::Zero();
	sinking[2] = 0.5;
	const Isometry3d T = poseAt(20);
	const Vector6d change = hull.acceleration(T, sinking, water, Vector6d::Zero()) -
							hull.acceleration(T, sinking, {}, Vector6d::Zero());
	// The added mass in sway is told that its water moves 0.05 m/s faster each second.
	const Vector6d force = (hull.rigidBodyMass() + hull.addedMass()) * change;
	EXPECT_NEAR(force[1], 70.4 * 0.05, 1e-9);
	EXPECT_NEAR(force[5], -1.95 * 0.05, 1e-9);
}

/** The Munk moment of the added mass turns a bare hull across; the lift of the stern holds it. */
TEST(Hull, KeepsItsCourseAtEverySpeed)
{
	for (double u = 0.1; u <= 2; u += 0.1)
		EXPECT_LT(greatestGrowth({}, u), 0) << u << " m/s";
	TVehicleOptions bare;
	bare.stern_lift = 0;
	EXPECT_GT(greatestGrowth(bare, 0.3), 0.05);
	bare.stern_lift = 50, bare.stern_position = 0.573;
	EXPECT_GT(greatestGrowth(bare, 0.3), 0.1) << "at the bow it makes matters worse";
}

TEST(Hull, FloorPushesTheEndThatTouches)
{
	const double floor = 6;
	const CHull hull({}, floor), free({}, kNoFloor);
	Isometry3d T = poseAt(floor - 0.115 + 0.02 - 1e-6);	 // the axis lies 2 cm above the origin
	EXPECT_LT((wrenchAtRest(hull, T) - wrenchAtRest(free, T)).norm(), 1e-9) << "just above";
	T.translation().z() += 0.005;
	const Vector6d level = wrenchAtRest(hull, T) - wrenchAtRest(free, T);
	EXPECT_NEAR(level[2], -2 * 2e4 * 0.005, 0.1);
	EXPECT_NEAR(level[4], 0, 1e-9);
	T.translation().z() = floor - 0.3;
	T.linear() = rotationFromYawPitchRoll(0, -0.3, 0);	// nose down
	const Vector6d nosed = wrenchAtRest(hull, T) - wrenchAtRest(free, T);
	EXPECT_LT(nosed[2], -10);
	EXPECT_GT(nosed[4], 10) << "lifts the bow";
}

TEST(Hull, NonsenseIsRefusedWithSectionAndKey)
{
	TVehicleOptions o;
	o.inertia_xz = 5;
	expectRefused([&] { CHull(o, kNoFloor); }, {"[Vehicle] inertia"});
	o = {};
	o.added_mass_sway_yaw = 80;
	expectRefused([&] { CHull(o, kNoFloor); }, {"[Vehicle] added_mass_sway_yaw", "positive definite"});
	o = {};
	o.centre_of_buoyancy = {0, 0, 0.02};
	expectRefused([&] { CHull(o, kNoFloor); }, {"[Vehicle] centre_of_buoyancy", "upside down"});
}
