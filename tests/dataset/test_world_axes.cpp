#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/dataset/world_axes.h>
#include <posidonia/geometry/se3.h>
#include <random_pose.h>
#include <temp_folder.h>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector3d;

namespace
{
TWorldAxes read(const std::string& text)
{
	CTempFolder folder;
	return readBodyYaml(folder.write("body.yaml", text));
}
}  // namespace

TEST(WorldAxes, EachWorldByHand)
{
	const Vector3d p(1, 2, 3);
	EXPECT_EQ(*mapFromWorld("NED") * p, Vector3d(1, 2, 3));
	EXPECT_EQ(*mapFromWorld("ENU") * p, Vector3d(2, 1, -3));
	EXPECT_EQ(*mapFromWorld("NWU") * p, Vector3d(1, -2, -3));
	EXPECT_FALSE(mapFromWorld("ned"));
	for (const char* name : {"NED", "ENU", "NWU"})
		EXPECT_EQ(mapFromWorld(name)->determinant(), 1) << name;
}

TEST(WorldAxes, TheBodyYamlSaysThem)
{
	EXPECT_EQ(readBodyYaml("/nowhere/body.yaml").R_map_world, *mapFromWorld("NWU"));
	EXPECT_EQ(read("comment: x\n").R_map_world, *mapFromWorld("NWU"));
	EXPECT_EQ(read("world: ENU\n").R_map_world, *mapFromWorld("ENU"));
	EXPECT_EQ(read("frame: NED\n").R_map_world, *mapFromWorld("NED"));
	EXPECT_EQ(read("frame: NED\nworld: NED\n").R_map_world, *mapFromWorld("NED"));
	const TWorldAxes axes = read("datum: [41.5, -3.25]\n");
	EXPECT_EQ(axes.datum->latitude, 41.5);
	EXPECT_EQ(axes.datum->longitude, -3.25);
	EXPECT_HOLDS(
		read("wrld: NED\n").warnings.at(0), "body.yaml:1: key 'wrld' has no effect; did you mean 'world'?");
}

TEST(WorldAxes, WhatContradictsItselfIsRefused)
{
	const auto problemOf = [](const std::string& text) { return errorOf<CError>([&] { read(text); }); };
	EXPECT_HOLDS(problemOf("world: up\n"), "body.yaml:1: world: 'up' is not known; NED, ENU or NWU");
	EXPECT_HOLDS(problemOf("\nframe: ENU\n"), "body.yaml:2: frame: only NED is known");
	EXPECT_HOLDS(problemOf("frame: NED\nworld: ENU\n"), "already says");
	EXPECT_HOLDS(problemOf("frame: NED\nT_FRD_body: [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]\n"), "already says");
	EXPECT_HOLDS(problemOf("datum: [95, 3]\n"), "body.yaml:1: datum: no latitude and longitude");
	EXPECT_HOLDS(problemOf("datum: 95\n"), "body.yaml:1: datum: a list of 2 numbers");
}

TEST(WorldAxes, PosesOfAFluBodyInNwuByHand)
{
	const TWorldAxes axes = read("T_FRD_body: [1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,0,1]\n");
	Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
	T_world_body.translation() = Vector3d(1, 2, 3);
	T_world_body.linear() = rotationFromYawPitchRoll(M_PI / 2, 0, 0);  // bow to the west
	const Eigen::Isometry3d T = axes.mapPose(T_world_body);
	EXPECT_LT((T.translation() - Vector3d(1, -2, -3)).norm(), 1e-15);
	EXPECT_LT((yawPitchRoll(T.linear()) - Vector3d(-M_PI / 2, 0, 0)).norm(), 1e-12);
	// a sensor forward, port and above is forward, starboard negative, down negative
	Eigen::Isometry3d T_BS = Eigen::Isometry3d::Identity();
	T_BS.translation() = Vector3d(0.5, 0.25, 0.125);
	EXPECT_LT((axes.mount(T_BS).translation() - Vector3d(0.5, -0.25, -0.125)).norm(), 1e-15);
}

TEST(WorldAxes, LevellingFindsPlantedRollAndPitch)
{
	std::mt19937 rng(6);
	for (int i = 0; i < 50; i++) {
		const Vector3d a = randomVector(rng, 1);
		const Eigen::Matrix3d R = rotationFromYawPitchRoll(0, 1.5 * a.x(), 3.1 * a.y());
		const Vector3d force = R.transpose() * Vector3d(0, 0, -9.81);
		EXPECT_LT((levellingRotation(force) - R).norm(), 1e-12) << "i=" << i;
	}
	// EuRoC's own body has x up
	const Eigen::Matrix3d R = levellingRotation({9.09, 0.13, -3.69});
	EXPECT_LT(
		(R * Vector3d(9.09, 0.13, -3.69) -
		 Vector3d(0, 0, -std::sqrt(9.09 * 9.09 + 0.13 * 0.13 + 3.69 * 3.69)))
			.norm(),
		1e-12);
}
