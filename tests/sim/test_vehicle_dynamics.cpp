#include <posidonia/obs/frames.h>

#include <cstring>
#include <random>

#include <allocation_counter.h>
#include "random_pose.h"
#include "vehicle_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
/** A pose about `depth` in any attitude. */
Isometry3d tumbled(std::mt19937& rng, double depth)
{
	Isometry3d T = randomPose(rng, 1, M_PI);
	T.translation().z() += depth;
	return T;
}
void setRandomVelocity(CVehicleDynamics& vehicle, std::mt19937& rng)
{
	const Vector3d v = randomVector(rng, 1), omega = randomVector(rng, 1);
	vehicle.setVelocity(v, omega);
}

double kineticEnergy(const CHull& hull, const TVehicleState& s)
{
	const Vector6d nu = velocityOf(s);
	return nu.dot((hull.rigidBodyMass() + hull.addedMass()) * nu) / 2;
}
/** Integral of submergedPart from far above to `depth`, by Simpson's rule. */
double submergedIntegral(double depth, double radius)
{
	const double top = std::min(depth, radius);
	if (top <= -radius) return 0;
	const int n = 2000;
	const double h = (top + radius) / n;
	double sum = submergedPart(-radius, radius) + submergedPart(top, radius);
	for (int i = 1; i < n; i++)
		sum += (i % 2 ? 4 : 2) * submergedPart(-radius + i * h, radius);
	return h / 3 * sum + std::max(0.0, depth - radius);
}
/** Of weight, buoyancy and floor for a hull so short that all its slices lie in its centre of buoyancy. */
double potentialEnergy(const TVehicleOptions& o, double floor, const TVehicleState& s)
{
	const Vector3d G(o.centre_of_gravity.data()), B(o.centre_of_buoyancy.data());
	const double depth_g = (s.T_map_body * G).z(), depth_b = (s.T_map_body * B).z();
	const double dug = std::max(0.0, depth_b + o.hull_radius - floor);
	return kGravity * (o.buoyancy_mass * submergedIntegral(depth_b, o.hull_radius) - o.mass * depth_g) +
		   o.floor_stiffness * dug * dug;  // both ends
}
TVehicleOptions shortHull(TVehicleOptions o)
{
	o.hull_length = 1e-9;
	o.centre_of_gravity = {0.05, 0.01, 0.02};
	return o;
}

/** Where a heading controller turns the vehicle at about 0.3 m/s, second by second from the step of 90 deg.
 */
std::vector<TVehicleState> headingStep()
{
	CVehicleDynamics vehicle = makeVehicle(50);
	std::vector<TVehicleState> states;
	const auto set_point = [](double newtons) {
		return newtons > 0 ? std::sqrt(newtons / 71.5) : -std::sqrt(-newtons / 30);
	};
	for (int i = 0; i < 1200; i++) {
		const TVehicleState s = stateAfter(vehicle, 0.1 * i);
		const double heading = yawPitchRoll(s.T_map_body.linear())[0], wanted = i < 600 ? 0 : M_PI / 2;
		const double moment = 8 * wrapAngle(wanted - heading) - 14 * s.omega_body.z();
		const double each = 3.15, turn = moment / (2 * 0.167);
		vehicle.setSetPoints({set_point(each - turn), set_point(each + turn), 0});
		if (i >= 600 && i % 10 == 0) states.push_back(s);
	}
	return states;
}

/** Distance of two end states after the same smooth run with these steps. */
double stepError(double step, double reference_step)
{
	std::vector<Vector6d> nu;
	std::vector<Isometry3d> T;
	for (const double h : {step, reference_step}) {
		TVehicleOptions o;
		o.quadratic_damping = std::vector<double>(6, 0.0);	// v |v| has no smooth second derivative
		o.stern_lift = 0;
		o.step = h;
		TThrusterOptions thrusters;
		thrusters.slew_rate = 0.1, thrusters.dead_band = 0;	 // the set-points move all the time
		CVehicleDynamics vehicle(o, thrusters, {}, kNoFloor, 1, poseAt(50));
		vehicle.setVelocity({0.8, 0.3, -0.2}, {1.5, -0.7, 0.9});
		vehicle.setSetPoints({0.6, -0.4, 0.3});
		const TVehicleState s = stateAfter(vehicle, 4);
		nu.push_back(velocityOf(s)), T.push_back(s.T_map_body);
	}
	return (nu[0] - nu[1]).norm() + localCoordinates(T[0], T[1]).norm();
}
}  // namespace

TEST(VehicleDynamics, TopSpeedIsNearTwoMetresASecond)
{
	CVehicleDynamics vehicle = makeVehicle(50);
	vehicle.setSetPoints({1, 1, 0});
	const TVehicleState s = stateAfter(vehicle, 60);
	EXPECT_NEAR(s.v_body.x(), 1.9, 0.15) << "3 to 4 knots are published";
	EXPECT_LT(s.a_map.norm(), 1e-3) << "steady";
	EXPECT_LT(std::abs(yawPitchRoll(s.T_map_body.linear())[1]), 0.1) << "level";
}

TEST(VehicleDynamics, CruiseAtThePapersSpeedTakesThreeToSixNewtons)
{
	// Drag by the damping's law; then the run, whose thrust is that of the set-points.
	const TVehicleOptions o;
	const double drag = (o.linear_damping[0] + o.quadratic_damping[0] * 0.3) * 0.3;
	EXPECT_GT(drag, 3);
	EXPECT_LT(drag, 6);
	CVehicleDynamics vehicle = makeVehicle(50);
	const double set_point = std::sqrt(drag / 2 / 71.5);
	vehicle.setSetPoints({set_point, set_point, 0});
	const TVehicleState s = stateAfter(vehicle, 100);
	EXPECT_NEAR(vehicle.thrusts()[0] + vehicle.thrusts()[1], drag, 1e-6);
	EXPECT_NEAR(s.v_body.x(), 0.3, 0.005);
}

TEST(VehicleDynamics, RisesByItsBuoyancyAndFloats)
{
	CVehicleDynamics vehicle = makeVehicle(3.5);
	// 30 w + 89 w^2 = 0.1 kg g
	const double terminal = (-30 + std::sqrt(900 + 4 * 89 * 0.1 * kGravity)) / (2 * 89);
	EXPECT_NEAR(stateAfter(vehicle, 60).v_map.z(), -terminal, 1e-4);
	const TVehicleState s = stateAfter(vehicle, 400);
	EXPECT_LT(s.v_map.norm(), 1e-4);
	const double axis = (s.T_map_body * Vector3d(0, 0, -0.02)).z();
	EXPECT_NEAR(submergedPart(axis, 0.115), 52 / 52.1, 1e-4) << "Archimedes";
}

TEST(VehicleDynamics, LiesOnTheFloorWhenItIsHeavy)
{
	TVehicleOptions o;
	o.mass = 53;
	CVehicleDynamics vehicle(o, {}, {}, 6, 1, poseAt(3.5));
	const TVehicleState s = stateAfter(vehicle, 120);
	EXPECT_LT(s.v_map.norm(), 1e-4);
	EXPECT_NEAR(s.T_map_body.translation().z(), 6 - 0.115 + 0.02, 1e-3);
}

TEST(VehicleDynamics, WithoutDampingEnergyStays)
{
	std::mt19937 rng(1);
	for (int run = 0; run < 10; run++) {
		const TVehicleOptions o = shortHull(idealFluid());
		CVehicleDynamics vehicle(o, {}, {}, kNoFloor, 1, tumbled(rng, 50));
		setRandomVelocity(vehicle, rng);
		const auto energy = [&](double t) {
			const TVehicleState s = stateAfter(vehicle, t);
			return kineticEnergy(vehicle.hull(), s) + potentialEnergy(o, kNoFloor, s);
		};
		const double start = energy(0);
		for (int i = 1; i <= 20; i++)
			EXPECT_NEAR(energy(i), start, 1e-4) << "run " << run << ", t = " << i;
	}
}

TEST(VehicleDynamics, EnergyIsNeverCreated)
{
	std::mt19937 rng(2);
	for (int run = 0; run < 40; run++) {
		const TVehicleOptions o = shortHull({});
		const double floor = 2;
		CVehicleDynamics vehicle(
			o, {}, {}, floor, 1, tumbled(rng, 1));	// in the air, in the water, on the floor
		setRandomVelocity(vehicle, rng);
		double before = std::numeric_limits<double>::infinity(), first = 0;
		for (int i = 0; i <= 300; i++) {
			const TVehicleState s = stateAfter(vehicle, 0.05 * i);
			const double now = kineticEnergy(vehicle.hull(), s) + potentialEnergy(o, floor, s);
			ASSERT_LE(now, before + 1e-5) << "run " << run << ", t = " << s.t;
			if (i == 0) first = now;
			before = now;
		}
		EXPECT_LT(before, first - 0.1) << "run " << run;
	}
}

TEST(VehicleDynamics, DriftsWithTheCurrent)
{
	TCurrentOptions current;
	current.speed = 0.3, current.direction = 2;
	TVehicleOptions o;
	o.buoyancy_mass = o.mass;
	CVehicleDynamics vehicle(o, {}, current, kNoFloor, 1, poseAt(50));
	EXPECT_NEAR(stateAfter(vehicle, 0).v_map.norm(), 0, 1e-12) << "starts at rest over ground";
	const Vector3d water(0.3 * std::cos(2), 0.3 * std::sin(2), 0);
	EXPECT_LT((stateAfter(vehicle, 150).v_map - water).norm(), 1e-5);
	EXPECT_LT((vehicle.waterVelocity() - water).norm(), 1e-12);
	vehicle.setAddedCurrent({0, 0.1, 0});
	EXPECT_LT((stateAfter(vehicle, 300).v_map - water - Vector3d(0, 0.1, 0)).norm(), 1e-5);
}

/** In a uniform current all goes as in still water, carried along: the law of the terms with nu_r. */
TEST(VehicleDynamics, UniformCurrentIsAMovingFrame)
{
	TCurrentOptions current;
	current.speed = 0.4, current.direction = -1;
	const Vector3d water(0.4 * std::cos(1), -0.4 * std::sin(1), 0);
	std::mt19937 rng(4);
	for (int run = 0; run < 5; run++) {
		const Isometry3d start = tumbled(rng, 50);
		const Vector3d v = randomVector(rng, 1), omega = randomVector(rng, 1);
		TVehicleOptions o;
		o.centre_of_gravity = {0.1, 0.02, 0.01};
		CVehicleDynamics still(o, {}, {}, kNoFloor, 1, start), carried(o, {}, current, kNoFloor, 1, start);
		still.setVelocity(v, omega);
		carried.setVelocity(v + start.linear().transpose() * water, omega);
		still.setSetPoints({0.7, 0.5, -0.3}), carried.setSetPoints({0.7, 0.5, -0.3});
		for (const double t : {1.0, 5.0, 20.0}) {
			const TVehicleState a = stateAfter(still, t), b = stateAfter(carried, t);
			EXPECT_LT((a.v_map + water - b.v_map).norm(), 1e-8) << "run " << run << ", t = " << t;
			EXPECT_LT((a.omega_body - b.omega_body).norm(), 1e-8) << "run " << run << ", t = " << t;
			EXPECT_LT((a.a_map - b.a_map).norm(), 1e-8) << "run " << run << ", t = " << t;
		}
	}
}

TEST(VehicleDynamics, GustsGoOnAsTheCurrentSays)
{
	TCurrentOptions options;
	options.gust_speed = 0.1, options.gust_time = 5;
	CVehicleDynamics vehicle({}, {}, options, kNoFloor, 3, poseAt(50));
	CCurrent current(options, TVehicleOptions().step, 3);
	for (int i = 0; i < 4000; i++, current.advance()) {
		if (i % 100 == 0) {
			ASSERT_EQ(vehicle.waterVelocity(), current.at(vehicle.time(), 50).velocity) << i;
		}
		vehicle.advanceTo(vehicle.time() + TVehicleOptions().step);
	}
}

TEST(VehicleDynamics, SwaySettlesAfterATurn)
{
	const auto states = headingStep();
	for (const auto& s : states)
		EXPECT_LT(std::abs(s.v_body.y()), 0.1) << "t = " << s.t;
	EXPECT_GT(std::abs(states[4].v_body.y()), 0.02) << "it does slide: there is no sway thruster";
	EXPECT_LT(std::abs(states.back().v_body.y()), 1e-3);
	EXPECT_NEAR(yawPitchRoll(states.back().T_map_body.linear())[0], M_PI / 2, 1e-3);
}

TEST(VehicleDynamics, IntegrationIsOfFourthOrder)
{
	const double coarse = stepError(0.04, 0.0025), fine = stepError(0.02, 0.0025);
	EXPECT_GT(coarse, 1e-9) << "too exact to tell";
	EXPECT_NEAR(coarse / fine, 16, 3);
	const double default_step = stepError(0.005, 0.00125);
	EXPECT_LT(default_step, 1e-6);
}

/** Accelerations, rates and velocities of stateAt() are the derivatives of what it says, anywhere in a step.
 */
TEST(VehicleDynamics, AccelerationsAreDerivatives)
{
	TCurrentOptions current;
	current.speed = 0.2, current.shear = 0.02, current.gust_speed = 0.1, current.gust_time = 4;
	CVehicleDynamics vehicle({}, {}, current, kNoFloor, 1, poseAt(5));
	vehicle.setVelocity({0.8, 0.3, -0.2}, {1.5, -0.7, 0.9});
	vehicle.setSetPoints({0.6, -0.4, 0.3});
	for (int i = 1; i <= 50; i++) {
		const double t = 0.2 * i + 0.00009 * i, d = 2e-5;
		vehicle.advanceTo(t - d);
		const TVehicleState a = vehicle.stateAt(t - d), s = vehicle.stateAt(t), b = vehicle.stateAt(t + d);
		EXPECT_EQ(s.t, t);
		EXPECT_LT(((b.v_map - a.v_map) / (2 * d) - s.a_map).norm(), 1e-6) << "t = " << t;
		EXPECT_LT(((b.omega_body - a.omega_body) / (2 * d) - s.alpha_body).norm(), 1e-6) << "t = " << t;
		const Vector6d step = localCoordinates(a.T_map_body, b.T_map_body) / (2 * d);
		EXPECT_LT((step.tail<3>() - s.omega_body).norm(), 1e-6) << "t = " << t;
		EXPECT_LT((s.T_map_body.linear() * s.v_body - s.v_map).norm(), 1e-12) << "t = " << t;
		const Vector3d moved = b.T_map_body.translation() - a.T_map_body.translation();
		EXPECT_LT((moved / (2 * d) - s.v_map).norm(), 1e-6) << "t = " << t;
	}
}

TEST(VehicleDynamics, StatesOfNeighbouringStepsMeet)
{
	CVehicleDynamics vehicle = makeVehicle(5);
	vehicle.setSetPoints({0.6, -0.4, 0.3});
	vehicle.advanceTo(2);
	const TVehicleState before = vehicle.stateAt(2.005);
	vehicle.advanceTo(2.005);
	EXPECT_NEAR(vehicle.time(), 2.005, 1e-12);
	EXPECT_LT(localCoordinates(before.T_map_body, vehicle.stateAt(2.005).T_map_body).norm(), 1e-12);
	EXPECT_LT((before.a_map - vehicle.stateAt(2.005).a_map).norm(), 1e-9);
	expectRefused([&] { vehicle.stateAt(2.02); }, {"2.02", "advanceTo"});
	expectRefused([&] { vehicle.stateAt(1.99); }, {"1.99"});
	vehicle.advanceTo(2.0099999);  // a stamp, rounded to its 100 ns
	EXPECT_NEAR(vehicle.time(), 2.01, 1e-12);
	EXPECT_EQ(vehicle.stateAt(2.0099999).t, 2.0099999);
}

TEST(VehicleDynamics, AnyAttitudeIsAsGoodAsAnother)
{
	CVehicleDynamics vehicle = makeVehicle(50, idealFluid());
	vehicle.setVelocity({0, 0, 0}, {0, 3, 0});	// over the top, again and again
	for (int i = 1; i <= 100; i++) {
		const Eigen::Matrix3d R = stateAfter(vehicle, 0.3 * i).T_map_body.linear();
		ASSERT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-14) << i;
		ASSERT_NEAR(R.determinant(), 1, 1e-14) << i;
	}
}

TEST(VehicleDynamics, SameCallsSameBytes)
{
	const auto run = [](uint64_t seed) {
		TCurrentOptions current;
		current.gust_speed = 0.1;
		CVehicleDynamics vehicle({}, {}, current, 6, seed, poseAt(3));
		std::vector<double> numbers;
		for (int i = 0; i < 200; i++) {
			const TVehicleState s = stateAfter(vehicle, 0.1 * i);
			vehicle.setSetPoints({0.3 * std::sin(0.1 * i), 0.3, 0.1});
			numbers.insert(numbers.end(), s.T_map_body.data(), s.T_map_body.data() + 16);
			numbers.insert(numbers.end(), s.a_map.data(), s.a_map.data() + 3);
		}
		return numbers;
	};
	const auto a = run(1), b = run(1), c = run(2);
	EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
	EXPECT_NE(a, c);
}

TEST(VehicleDynamics, AllocatesNothingUnderWay)
{
	TCurrentOptions current;
	current.gust_speed = 0.1;
	CVehicleDynamics vehicle({}, {}, current, 6, 1, poseAt(0.2));
	const size_t before = allocations();
	for (int i = 0; i < 50; i++) {
		vehicle.advanceTo(0.1 * i);
		vehicle.setSetPoints({0.2, 0.3, 0.1});
		vehicle.setEfficiency({1, 0.5, 1});
		vehicle.setAddedCurrent({0.01 * i, 0, 0});
		vehicle.stateAt(0.1 * i + 0.003);
	}
	EXPECT_EQ(allocations(), before);
}

TEST(VehicleDynamics, AMotionThatLeavesTheFiniteIsAnError)
{
	TVehicleOptions o;
	o.linear_damping[0] = 1e6;
	CVehicleDynamics vehicle = makeVehicle(5, o);
	vehicle.setSetPoints({1, 1, 0});
	expectRefused([&] { vehicle.advanceTo(100); }, {"[Vehicle] step"});
}
