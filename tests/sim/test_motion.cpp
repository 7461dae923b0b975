#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/geometry/se3.h>
#include <posidonia/sim/vehicle_motion.h>

using namespace posidonia;
using Eigen::Vector3d;

namespace
{
TMotionOptions still()
{
	TMotionOptions o;
	o.roll = o.pitch = o.yaw = o.heave = o.sway = 0;
	return o;
}
TMotionOptions lively()
{
	TMotionOptions o;
	o.roll = 0.2, o.pitch = 0.15, o.yaw = 0.1, o.heave = 0.2, o.sway = 0.1;
	return o;
}
constexpr double kStep = 1e-4;
}  // namespace

TEST(Motion, DerivativesAreThoseOfThePose)
{
	const CVehicleMotion motion(TRouteOptions(), lively(), 3);
	for (double t = 0.05; t < motion.plan().duration(); t += 3.71) {
		const auto before = motion.at(t - kStep), now = motion.at(t), after = motion.at(t + kStep);
		const Vector3d v = (after.T_map_body.translation() - before.T_map_body.translation()) / (2 * kStep);
		const Vector3d a = (after.v_map - before.v_map) / (2 * kStep);
		const Vector3d w =
			logSO3(before.T_map_body.linear().transpose() * after.T_map_body.linear()) / (2 * kStep);
		const Vector3d alpha = (after.omega_body - before.omega_body) / (2 * kStep);
		EXPECT_LT((v - now.v_map).norm(), 1e-7) << "t=" << t;
		EXPECT_LT((a - now.a_map).norm(), 1e-6) << "t=" << t;
		EXPECT_LT((w - now.omega_body).norm(), 1e-6) << "t=" << t;
		EXPECT_LT((alpha - now.alpha_body).norm(), 1e-6) << "t=" << t;
		EXPECT_LT((now.T_map_body.linear() * now.v_body - now.v_map).norm(), 1e-12) << "t=" << t;
	}
}

TEST(Motion, AccelerationIsContinuous)
{
	const CVehicleMotion motion(TRouteOptions(), TMotionOptions(), 3);
	double largest = 0;
	for (double t = 0; t < motion.plan().duration(); t += 0.01)
		largest = std::max(largest, (motion.at(t + 0.01).a_map - motion.at(t).a_map).norm());
	EXPECT_LT(largest, 0.01);  // a jump would be of the size of the acceleration, 0.15
}

TEST(Motion, StartsAtRestExactlyAtTheStart)
{
	TRouteOptions route;
	route.start = {1, -2, 0.5, 30};
	const auto s = CVehicleMotion(route, lively(), 8).at(0);
	EXPECT_LT((s.T_map_body.translation() - Vector3d(1, -2, 0.5)).norm(), 1e-15);
	EXPECT_LT((s.T_map_body.linear() - rotationFromYawPitchRoll(M_PI / 6, 0, 0)).norm(), 1e-15);
	EXPECT_EQ(s.v_map.norm() + s.omega_body.norm() + s.a_map.norm() + s.alpha_body.norm(), 0);
}

TEST(Route, IsTableOneOfThePaper)
{
	const CRoutePlan plan{TRouteOptions()};
	EXPECT_NEAR(plan.length(), 183.5, 1e-9);  // 180 m and the dive
	ASSERT_EQ(plan.arrivals().size(), 19u);
	EXPECT_EQ(plan.arrivals()[0].position, Vector3d(0, 0, 0));
	EXPECT_EQ(plan.arrivals()[1].position, Vector3d(0, 0, 3.5));
	EXPECT_EQ(plan.arrivals()[9].position, Vector3d(-5, -6, 3.5));
	EXPECT_EQ(plan.arrivals()[18].position, Vector3d(0, 0, 3.5));
}

TEST(Route, RestsAtEverySetPoint)
{
	const CVehicleMotion motion(TRouteOptions(), still(), 1);
	for (const auto& a : motion.plan().arrivals()) {
		const auto s = motion.at(a.t);
		EXPECT_LT((s.T_map_body.translation() - a.position).norm(), 1e-12) << a.position.transpose();
		EXPECT_LT(s.v_map.norm() + s.omega_body.norm(), 1e-12) << a.position.transpose();
	}
}

TEST(Route, SmallMotionStaysWithinItsAmplitudes)
{
	const CVehicleMotion motion(TRouteOptions(), TMotionOptions(), 4), exact(TRouteOptions(), still(), 4);
	for (double t = 0; t < 200; t += 0.37) {
		const Vector3d off = motion.at(t).T_map_body.translation() - exact.at(t).T_map_body.translation();
		EXPECT_LE(std::abs(off.z()), 0.03) << "t=" << t;
		EXPECT_LE(off.head<2>().cwiseAbs().maxCoeff(), 0.02) << "t=" << t;
	}
}

TEST(Route, KeepsSpeedTurnRateAndHeadingAlongTheLeg)
{
	const TRouteOptions route;
	const CVehicleMotion motion(route, still(), 1);
	double top_speed = 0, top_rate = 0, top_acceleration = 0;
	for (double t = 0; t < motion.plan().duration(); t += 0.05) {
		const auto s = motion.at(t);
		top_speed = std::max(top_speed, s.v_map.norm());
		top_acceleration = std::max(top_acceleration, s.a_map.norm());
		top_rate = std::max(top_rate, s.omega_body.norm());
		if (s.v_map.head<2>().norm() > 1e-6) {
			EXPECT_NEAR(s.v_body.y(), 0, 1e-9) << "t=" << t;
			EXPECT_GT(s.v_body.x(), 0) << "t=" << t;
			EXPECT_LT(s.omega_body.norm(), 1e-12) << "turns on the spot only; t=" << t;
		}
	}
	EXPECT_NEAR(top_speed, route.speed, 1e-9);
	EXPECT_NEAR(top_acceleration, route.acceleration, 1e-3);
	EXPECT_NEAR(top_rate, route.turn_rate, 1e-3);
}

TEST(Route, ShortLegStaysBelowTheSpeed)
{
	const CLegProfile leg(0.1, 0.3, 0.15);
	EXPECT_NEAR(leg.at(leg.duration()).value, 0.1, 1e-15);
	EXPECT_NEAR(leg.at(leg.duration() / 2).value, 0.05, 1e-12);
	EXPECT_LT(leg.at(leg.duration() / 2).rate, 0.3);
}

TEST(Route, RefusesHalfAPair)
{
	TRouteOptions route;
	route.way_points = {1, 2, 3};
	EXPECT_THROW(CRoutePlan{route}, CError);
}
