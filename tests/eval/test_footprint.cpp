#include "eval_testing.h"

#include <posidonia/eval/footprint.h>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
Isometry3d bodyAt(double x, double y, double z, double yaw, double pitch = 0, double roll = 0)
{
	Isometry3d T = Isometry3d::Identity();
	T.linear() = rotationFromYawPitchRoll(yaw, pitch, roll);
	T.translation() << x, y, z;
	return T;
}

/** Does the camera see this point of the floor? By projection: nothing of the polygons. */
bool sees(const TFootprintCamera& c, const Isometry3d& T_map_body, const Vector2d& floor)
{
	const Vector3d p = (T_map_body * c.T_body_cam).inverse() * Vector3d(floor.x(), floor.y(), c.floor_depth);
	if (p.z() <= 0) return false;
	const Vector3d uvr = c.camera.project(p);
	return uvr.x() >= -0.5 && uvr.x() <= c.camera.width - 0.5 && uvr.y() >= -0.5 &&
		   uvr.y() <= c.camera.height - 0.5;
}

/** Share of the smaller footprint that both see, by throwing points. */
double overlapByMonteCarlo(
	const TFootprintCamera& c, const Isometry3d& A, const Isometry3d& B, std::mt19937& rng, int n)
{
	std::uniform_real_distribution<double> u(-8, 8);
	int in_a = 0, in_b = 0, in_both = 0;
	for (int i = 0; i < n; i++) {
		const double x = u(rng), y = u(rng);
		const bool a = sees(c, A, {x, y}), b = sees(c, B, {x, y});
		in_a += a;
		in_b += b;
		in_both += a && b;
	}
	return static_cast<double>(in_both) / std::min(in_a, in_b);
}
}  // namespace

TEST(Footprint, OfALevelCameraIsTheRectangleOfPinholeGeometry)
{
	const TFootprintCamera c;  // 640 x 480, f = 283 px, floor at 6 m
	const TPolygon p = footprint(c, bodyAt(1, 2, 3.5, 0));
	const double width = 2.5 * 640 / 283, height = 2.5 * 480 / 283;
	EXPECT_NEAR(area(p), width * height, 1e-9);
	double x_max = -99, y_max = -99;
	for (const auto& corner : p) {
		x_max = std::max(x_max, corner.x());
		y_max = std::max(y_max, corner.y());
	}
	EXPECT_NEAR(x_max, 1 + height / 2, 1e-9) << "the image's height lies along the bow (north)";
	EXPECT_NEAR(y_max, 2 + width / 2, 1e-9) << "the image's width lies along starboard (east)";
}

TEST(Footprint, EmptyWhenTheFloorIsNotSeen)
{
	const TFootprintCamera c;
	EXPECT_TRUE(footprint(c, bodyAt(0, 0, 6.5, 0)).empty()) << "below the floor";
	EXPECT_TRUE(footprint(c, bodyAt(0, 0, 3.5, 0, 1.2)).empty()) << "a corner looks above the horizon";
	EXPECT_EQ(overlap(footprint(c, bodyAt(0, 0, 6.5, 0)), footprint(c, bodyAt(0, 0, 3.5, 0))), 0);
}

TEST(Footprint, OverlapAgreesWithMonteCarlo)
{
	std::mt19937 rng(16);
	std::uniform_real_distribution<double> u(-1, 1);
	const TFootprintCamera c;
	for (int i = 0; i < 12; i++) {
		const Isometry3d A =
			bodyAt(u(rng), u(rng), 3.5 + 0.5 * u(rng), 3 * u(rng), 0.1 * u(rng), 0.1 * u(rng));
		const Isometry3d B =
			bodyAt(2 * u(rng), 2 * u(rng), 3.5 + 0.5 * u(rng), 3 * u(rng), 0.1 * u(rng), 0.1 * u(rng));
		const double expected = overlapByMonteCarlo(c, A, B, rng, 100000);
		EXPECT_NEAR(overlap(footprint(c, A), footprint(c, B)), expected, 0.02) << "i=" << i;
	}
}

TEST(Footprint, OverlapLaws)
{
	std::mt19937 rng(17);
	const TFootprintCamera c;
	const TPolygon a = footprint(c, bodyAt(0, 0, 3.5, 0.4));
	EXPECT_NEAR(overlap(a, a), 1, 1e-12);
	EXPECT_NEAR(overlap(a, footprint(c, bodyAt(0, 0, 5, 0.4))), 1, 1e-12) << "one inside the other";
	EXPECT_EQ(overlap(a, footprint(c, bodyAt(20, 0, 3.5, 0))), 0);
	for (int i = 0; i < 20; i++) {
		const Vector3d d = randomVector(rng, 3);
		const TPolygon b = footprint(c, bodyAt(d.x(), d.y(), 3.5, d.z()));
		EXPECT_NEAR(overlap(a, b), overlap(b, a), 1e-12) << "i=" << i;
	}
	// Half of a rectangle's height further along the bow: half is in common.
	const TPolygon level = footprint(c, bodyAt(0, 0, 3.5, 0));
	EXPECT_NEAR(overlap(level, footprint(c, bodyAt(1.25 * 480 / 283, 0, 3.5, 0))), 0.5, 1e-9);
}
