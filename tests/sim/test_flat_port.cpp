#include <posidonia/base/error.h>
#include <posidonia/sim/flat_port.h>

#include "temp_folder.h"
#include "world_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector3d;

namespace
{
TPortOptions port(double distance, double glass, double rectified_at)
{
	return {"flat", distance, glass, 1.49, 1.34, rectified_at};
}
size_t pixelOf(const TStereoCamera& c, int u, int v)
{
	return static_cast<size_t>(v * c.width + u);
}
/** Where the ray of a pixel is at `z` along the axis [m]. */
Vector3d at(const TViewRays& rays, size_t i, double z)
{
	const Vector3d o = rays.origin[i].cast<double>(), d = rays.direction[i].cast<double>();
	return o + (z - o.z()) / d.z() * d;
}
/** A camera that water lets see to its corners (behind a flat port: less than 48 degrees off the axis). */
TStereoCamera narrow()
{
	TStereoCamera c;
	c.fx = c.fy = 420;
	return c;
}
}  // namespace

TEST(FlatPort, NormalRayIsNotBent)
{
	const TPortRay ray = throughPort(port(0.05, 0.02, 0), 0);
	EXPECT_EQ(ray.radius, 0);
	EXPECT_EQ(ray.sine, 0);
	EXPECT_EQ(ray.cosine, 1);
}

TEST(FlatPort, SnellsLawHoldsAtBothFaces)
{
	const TPortOptions p = port(0.05, 0.02, 0);
	for (const double angle : {0.05, 0.3, 0.7, 1.2}) {
		const TPortRay ray = throughPort(p, std::sin(angle));
		EXPECT_NEAR(p.n_water * ray.sine, std::sin(angle), 1e-12) << angle;
		EXPECT_NEAR(ray.sine * ray.sine + ray.cosine * ray.cosine, 1, 1e-12) << angle;
		// In the glass: from the radius on the inner face to that on the outer.
		const double in_glass = std::atan((ray.radius - p.distance * std::tan(angle)) / p.glass);
		EXPECT_NEAR(p.n_glass * std::sin(in_glass), std::sin(angle), 1e-12) << angle;
	}
}

TEST(FlatPort, NearTheAxisWaterMagnifiesByItsIndex)
{
	const TStereoCamera camera;	 // calibrated in air
	const TViewRays rays = viewRays(camera, port(0, 0, 0));
	const size_t i = pixelOf(camera, 322, 240);
	const Vector3d p = at(rays, i, 2.5);
	EXPECT_NEAR(2.5 * (322 - camera.cx) / camera.fx / p.x(), 1.34, 1e-4) << "x";
	EXPECT_NEAR(2.5 * (240 - camera.cy) / camera.fy / p.y(), 1.34, 1e-4) << "y";
	EXPECT_NEAR(rays.focal, 1.34 * camera.fx, 1e-9);
	// Farther off the axis it magnifies more: the pictures look like a pincushion.
	const Vector3d corner = at(rays, pixelOf(camera, 0, 0), 2.5);
	EXPECT_GT(2.5 * (0 - camera.cx) / camera.fx / corner.x(), 1.5);
}

TEST(FlatPort, RectifiedThePinHoleIsExactAtItsDistanceOnly)
{
	const TStereoCamera camera = narrow();
	const TViewRays rays = viewRays(camera, port(0.05, 0.02, 2.5));
	for (const auto& [u, v] :
		 {std::pair(0, 0), std::pair(639, 100), std::pair(320, 479), std::pair(319, 239)}) {
		const Vector3d pin_hole((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
		const size_t i = pixelOf(camera, u, v);
		ASSERT_EQ(rays.lit[i], 1);
		EXPECT_LT((at(rays, i, 2.5) - 2.5 * pin_hole).norm(), 1e-6) << u << " " << v;
	}
	const size_t corner = pixelOf(camera, 0, 0);
	const Vector3d pin_hole((0 - camera.cx) / camera.fx, (0 - camera.cy) / camera.fy, 1);
	EXPECT_GT((at(rays, corner, 1.5) - 1.5 * pin_hole).norm(), 0.01) << "nearer: another centre";
}

TEST(FlatPort, WithoutItRaysAreThePinHoles)
{
	const TStereoCamera camera;
	const TViewRays rays = viewRays(camera, {});
	for (const auto& [u, v] : {std::pair(0, 0), std::pair(500, 33)}) {
		const Vector3d d = at(rays, pixelOf(camera, u, v), 1);
		EXPECT_LT((d - Vector3d((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1)).norm(), 1e-6);
	}
}

TEST(FlatPort, PicturesAreThoseOfTheRays)
{
	// Over a level floor at the distance of rectification the picture is the pin-hole's; nearer it is not.
	const TStereoCamera camera = narrow();
	const auto floor = std::make_shared<CFlatSeaFloor>(kSeaFloor);
	TOptics optics = perfectOptics();
	const CFloorRenderer pin_hole(rockTexture(), floor, camera, optics);
	optics.port = port(0.05, 0.02, 2.5);
	const CFloorRenderer behind(rockTexture(), floor, camera, optics);
	const auto difference = [&](double height) {
		const auto view = cameraAt(0, 0, kSeaFloor - height, 0.4);
		return cv::norm(pin_hole.render(view, 1), behind.render(view, 1), cv::NORM_L1) / 640 / 480;
	};
	EXPECT_LT(difference(2.5), 0.3);
	EXPECT_GT(difference(1.2), 2);
}

TEST(FlatPort, PastTheCriticalAngleThePictureIsBlack)
{
	const TStereoCamera wide;  // corners 54.7 degrees off the axis: no ray of the water comes in there
	TOptics optics = perfectOptics();
	optics.port = port(0.02, 0.01, 2.5);
	const CFloorTexture grey = plainTexture(200);
	const CFloorRenderer renderer(grey, std::make_shared<CFlatSeaFloor>(kSeaFloor), wide, optics);
	const cv::Mat picture = renderer.render(cameraAt(0, 0, 3.5), 1);
	EXPECT_EQ(picture.at<uint8_t>(0, 0), 0);
	EXPECT_EQ(picture.at<uint8_t>(240, 320), 200);
	optics.port = port(0.02, 0.01, 0);	// raw: every pixel of the camera sees the water
	const CFloorRenderer raw(grey, std::make_shared<CFlatSeaFloor>(kSeaFloor), wide, optics);
	EXPECT_EQ(raw.render(cameraAt(0, 0, 3.5), 1).at<uint8_t>(0, 0), 200);
}

TEST(FlatPort, RectifiedWithinThePortIsRefused)
{
	EXPECT_HOLDS(errorOf<CError>([] { viewRays(TStereoCamera(), port(0.5, 0.1, 0.55)); }), "rectified_at");
}
