#include <posidonia/base/error.h>
#include <posidonia/sim/random.h>
#include <posidonia/sim/relief_sea_floor.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sensor_test_tools.h"
#include "temp_folder.h"
#include "world_test_tools.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
/** Depths f(north, east) on a square grid of `metres`. */
template <class F>
TDepthGrid gridOf(double metres, double resolution, F&& f)
{
	const int n = static_cast<int>(std::lround(metres / resolution)) + 1;
	TDepthGrid grid{cv::Mat1f(n, n), resolution};
	for (int j = 0; j < n; j++)
		for (int i = 0; i < n; i++)
			grid.depth(j, i) =
				static_cast<float>(f(((n - 1) / 2.0 - j) * resolution, (i - (n - 1) / 2.0) * resolution));
	return grid;
}
/** 6 m deep at the origin, deeper to the north, shallower to the east. */
constexpr double kPerNorth = 0.05, kPerEast = -0.1;
double slopeDepth(double north, double east)
{
	return kSeaFloor + kPerNorth * north + kPerEast * east;
}
std::shared_ptr<const CReliefSeaFloor> slope()
{
	return std::make_shared<CReliefSeaFloor>(gridOf(30, 0.05, slopeDepth));
}
TReliefOptions bumpy()
{
	TReliefOptions o;
	o.kind = "procedural", o.boulder_density = 0.5, o.boulder_size = 0.4;
	return o;
}
TFloorOptions smallFloor()
{
	TFloorOptions o;
	o.extent_north = 14, o.extent_east = 16;
	return o;
}
const CReliefSeaFloor& bumpyFloor()
{
	static const CReliefSeaFloor floor(makeRelief(bumpy(), smallFloor(), 3));
	return floor;
}
struct TExtremes
{
	double low{0}, high{0};
};
TExtremes extremesOf(const cv::Mat1f& depth)
{
	TExtremes e;
	cv::minMaxLoc(depth, &e.low, &e.high);
	return e;
}
const Isometry3d kViews[] = {
	cameraAt(0, 0, 3.5), cameraAt(0.3, -0.7, 3.4, 1.1, 0.03, -0.05),
	cameraAt(-1.3, 0.9, 4.2, -2.5, -0.3, 0.4)};
}  // namespace

TEST(Relief, WithoutHeightItLooksLikeThePlane)
{
	const TStereoCamera camera;
	const auto level =
		std::make_shared<CReliefSeaFloor>(gridOf(30, 0.05, [](double, double) { return kSeaFloor; }));
	const auto plane = std::make_shared<CFlatSeaFloor>(kSeaFloor);
	const CFloorRenderer relief(rockTexture(), level, camera, perfectOptics());
	const CFloorRenderer planar(rockTexture(), plane, camera, perfectOptics());
	for (const Isometry3d& view : {cameraAt(0, 0, 3.5), cameraAt(0.3, -0.7, 3.4, 1.1)}) {
		EXPECT_LE(cv::norm(relief.render(view, 1), planar.render(view, 1), cv::NORM_INF), 1);
		EXPECT_LT(cv::norm(relief.depths(view), planar.depths(view), cv::NORM_INF), 1e-5);
	}
	// Tilted, the plane has one mip level for the whole picture, the relief one for each pixel.
	const Isometry3d tilted = cameraAt(0.3, -0.7, 3.4, 1.1, 0.03, -0.02);
	EXPECT_LT(cv::norm(relief.render(tilted, 1), planar.render(tilted, 1), cv::NORM_L1) / 640 / 480, 0.5);
	EXPECT_LT(cv::norm(relief.depths(tilted), planar.depths(tilted), cv::NORM_INF), 1e-5);
}

TEST(Relief, SlopeHasThePlanesDepthsGradientsAndRanges)
{
	const auto floor = slope();
	const TStereoCamera camera;
	CSeaFloor::TGradients gradient(1);
	for (const Vector2d& p : {Vector2d(0, 0), Vector2d(3.333, -7.77), Vector2d(-14.9, 14.9)}) {
		EXPECT_NEAR(floor->depthAt(p), slopeDepth(p.x(), p.y()), 2e-6) << p.transpose();
		floor->gradientsAt({static_cast<float>(p.x())}, {static_cast<float>(p.y())}, gradient);
		EXPECT_NEAR(gradient.per_north[0], kPerNorth, 1e-4) << p.transpose();
		EXPECT_NEAR(gradient.per_east[0], kPerEast, 1e-4) << p.transpose();
	}
	const CFloorRenderer renderer(rockTexture(), floor, camera, perfectOptics());
	for (const Isometry3d& view : kViews) {
		const Vector3d c = view.translation();
		const cv::Mat1f depths = renderer.depths(view);
		for (int v = 0; v < camera.height; v += 7)
			for (int u = 0; u < camera.width; u += 9) {
				const Vector3d d = rayOf(camera, view, u, v);
				const double rate = d.z() - kPerNorth * d.x() - kPerEast * d.y();
				const double range = (slopeDepth(c.x(), c.y()) - c.z()) / rate;
				EXPECT_NEAR(floor->rangeAlong(c, d), range, 2e-6 * range) << u << " " << v;
				EXPECT_NEAR(depths(v, u), range * view.linear().col(2).dot(d), 2e-5) << u << " " << v;
			}
	}
}

TEST(Relief, RaysEndOnTheSurfaceThatDepthAtTells)
{
	CNoise draw(7);
	for (int i = 0; i < 2000; i++) {
		const Vector3d from(draw.uniform(-6, 6), draw.uniform(-7, 7), draw.uniform(2, 5.5));
		const Vector3d along =
			Vector3d(draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(0.3, 1)).normalized();
		const double range = bumpyFloor().rangeAlong(from, along);
		const Vector3d end = from + range * along;
		EXPECT_NEAR(bumpyFloor().depthAt(end.head<2>()), end.z(), 2e-5) << i << ": " << end.transpose();
		for (double before = 0; before < range - 1e-3; before += 0.01) {
			const Vector3d p = from + before * along;
			ASSERT_GT(bumpyFloor().depthAt(p.head<2>()), p.z() - 1e-5) << i << ": passed through the floor";
		}
	}
}

TEST(Relief, PictureOfDepthsAgreesWithSingleRays)
{
	const TStereoCamera camera;
	for (const TPortOptions& port : {TPortOptions(), TPortOptions{"flat", 0.05, 0.02, 1.49, 1.34, 0}}) {
		const TViewRays rays = viewRays(camera, port);
		size_t wrong = 0;
		for (const Isometry3d& view : kViews) {
			const cv::Mat1f ranges = bumpyFloor().rangesAlong(rays, view);
			for (size_t i = 0; i < rays.size(); i += 3) {
				const double single = bumpyFloor().rangeAlong(
					view * rays.origin[i].cast<double>(), view.linear() * rays.direction[i].cast<double>());
				wrong += !(std::abs(static_cast<double>(ranges.ptr<float>()[i]) - single) < 1e-4);
			}
		}
		EXPECT_LE(wrong, 3u) << port.kind << ": of 307200";
	}
}

TEST(Relief, DisparityOfAPlantedBlockIsFocalLengthTimesBaselineOverDepth)
{
	// A block of 1 m x 1 m, 0.4 m high; edges one cell wide.
	const auto floor = std::make_shared<CReliefSeaFloor>(gridOf(14, 0.02, [](double north, double east) {
		return std::abs(north) <= 0.5 && std::abs(east) <= 0.5 ? kSeaFloor - 0.4 : kSeaFloor;
	}));
	const TStereoCamera camera;
	const CFloorRenderer renderer(rockTexture(), floor, camera, perfectOptics());
	const Isometry3d left = cameraAt(0, 0, 3.5, 0.3);
	const TGreyPair pair = renderPair(renderer, left, camera.baseline, 1, 0);
	const auto disparityAt = [&](const cv::Point& at) {
		const cv::Rect patch(at.x - 15, at.y - 15, 31, 31), strip(at.x - 60, at.y - 15, 31 + 60, 31);
		cv::Mat score;
		cv::matchTemplate(pair.right(strip), pair.left(patch), score, cv::TM_CCOEFF_NORMED);
		cv::Point best;
		cv::minMaxLoc(score, nullptr, nullptr, nullptr, &best);
		const auto s = [&](int i) { return static_cast<double>(score.at<float>(0, best.x + i)); };
		const double vertex = (s(-1) - s(1)) / (2 * (s(-1) - 2 * s(0) + s(1)));
		return 45 - (best.x + vertex);
	};
	const double fb = camera.fx * camera.baseline;
	EXPECT_NEAR(disparityAt({330, 240}), fb / 2.1, 0.1) << "on the block";
	EXPECT_NEAR(disparityAt({150, 100}), fb / 2.5, 0.1) << "beside it";
	const cv::Mat1f depths = renderer.depths(left);
	EXPECT_NEAR(depths(240, 330), 2.1, 1e-5);
	EXPECT_NEAR(depths(100, 150), 2.5, 1e-5);
}

TEST(Relief, LightFallsOffWithTheCosineOfTheSlope)
{
	const CFloorTexture grey = plainTexture(200);
	const CFloorRenderer renderer(grey, slope(), TStereoCamera(), perfectOptics());
	const double cosine = 1 / std::sqrt(1 + kPerNorth * kPerNorth + kPerEast * kPerEast);
	EXPECT_NEAR(meanOf(renderer.render(cameraAt(0, 0, 3.5), 1)), 200 * cosine, 0.6);
}

TEST(Relief, MipLevelFollowsEachPixelsDepth)
{
	// Stripes one texel wide are grey on every level but the finest: contrast is left where the camera is
	// near.
	cv::Mat stripes(3200, 3200, CV_8U);
	for (int i = 0; i < stripes.cols; i++)
		stripes.col(i).setTo(i % 2 ? 250 : 0);
	const CFloorTexture texture(stripes, kTexel);
	// North of the origin a shelf 1 m below the camera (0.7 texels a pixel), south of it 3 m (2.1 texels).
	const auto floor = std::make_shared<CReliefSeaFloor>(
		gridOf(14, 0.02, [](double north, double) { return north > 0 ? 4.0 : 6.0; }));
	const CFloorRenderer renderer(texture, floor, TStereoCamera(), perfectOptics());
	const cv::Mat picture = renderer.render(cameraAt(0, 0, 3.0), 1);
	EXPECT_GT(sigmaOf(picture(cv::Rect(100, 20, 400, 150))), 60) << "near: level 0";
	EXPECT_LT(sigmaOf(picture(cv::Rect(100, 380, 400, 80))), 2) << "far: level 1 and coarser";
}

TEST(Relief, BeyondTheGridTheBorderGoesOnAndTheHorizonIsEmpty)
{
	const auto floor = slope();
	EXPECT_NEAR(floor->depthAt({500, 0}), slopeDepth(15, 0), 1e-5);
	EXPECT_NEAR(floor->depthAt({2, -90}), slopeDepth(2, -15), 1e-5);
	const Vector3d from(40, 2, 3), along = Vector3d(0.6, 0, 0.8);
	EXPECT_NEAR(floor->rangeAlong(from, along), (slopeDepth(15, 2) - 3) / 0.8, 1e-3);
	EXPECT_TRUE(std::isinf(floor->rangeAlong({0, 0, 2}, {0, 0, -1})));
	EXPECT_TRUE(std::isinf(floor->rangeAlong({0, 0, 2}, Vector3d(1, 0, -0.01).normalized())));
	const CFloorRenderer renderer(
		rockTexture(), floor, TStereoCamera(), {{0.3, 0.3, 60, "none"}, perfectSensor(), {}, {}});
	const cv::Mat ahead = renderer.render(cameraAt(0, 0, 3.5, 0, M_PI / 2, 0), 1);
	EXPECT_NEAR(ahead.at<uint8_t>(0, 320), 60, 1) << "endless water";
	EXPECT_TRUE(std::isinf(renderer.depths(cameraAt(0, 0, 3.5, 0, M_PI / 2, 0))(0, 320)));
	for (const Isometry3d& far : {cameraAt(60, 0, 3.5), cameraAt(0, 0, 7), cameraAt(900, -900, 3.5, 1, 1, 1)})
		EXPECT_EQ(renderer.render(far, 1).size(), cv::Size(640, 480)) << "off the texture, or in the floor";
}

TEST(Relief, ProceduralFillsItsHeightAndFollowsTheSeed)
{
	for (const double height : {0.3, 0.6}) {
		TReliefOptions o = bumpy();
		o.height = height;
		const TDepthGrid a = makeRelief(o, smallFloor(), 1);
		EXPECT_NEAR(extremesOf(a.depth).low, kSeaFloor - height, 1e-4);
		EXPECT_NEAR(extremesOf(a.depth).high, kSeaFloor + height, 1e-4);
		EXPECT_EQ(cv::norm(a.depth, makeRelief(o, smallFloor(), 1).depth, cv::NORM_INF), 0);
		EXPECT_GT(cv::norm(a.depth, makeRelief(o, smallFloor(), 2).depth, cv::NORM_INF), height / 2);
	}
}

TEST(Relief, SlopeRisesInItsDirection)
{
	TReliefOptions o;
	o.kind = "procedural", o.ripple_height = 0, o.boulder_density = 0;
	o.slope = 0.02, o.slope_direction = M_PI / 2;
	const TDepthGrid grid = makeRelief(o, smallFloor(), 1);
	o.height = 0.02 * (grid.depth.cols - 1) * o.resolution / 2 + 1e-5;	// no room for hills
	const cv::Mat1f depth = makeRelief(o, smallFloor(), 1).depth;
	EXPECT_NEAR(depth(9, 100) - depth(9, 50), -0.02 * 50 * o.resolution, 1e-4) << "rises to the east";
	EXPECT_NEAR(depth(9, 50) - depth(200, 50), 0, 1e-4);
}

TEST(Relief, RipplesHaveTheirHeightLengthAndDirection)
{
	TReliefOptions o;
	o.kind = "procedural", o.boulder_density = 0, o.ripple_height = 0.05, o.ripple_length = 0.5;
	o.ripple_direction = 0, o.height = 0.025;  // no room for hills
	const cv::Mat1f depth = makeRelief(o, smallFloor(), 1).depth;
	// Crests along east, passed from north to south: zero crossings twice a length; a wandering phase evens
	// out.
	int crossings = 0;
	for (int i = 0; i < depth.cols; i++)
		for (int j = 1; j < depth.rows; j++)
			crossings += (depth(j, i) > 6) != (depth(j - 1, i) > 6);
	const double metres = (depth.rows - 1) * o.resolution * depth.cols;
	EXPECT_NEAR(metres / (crossings / 2.0), 0.5, 0.03);
	EXPECT_NEAR(sigmaOf(depth), 0.025 / std::sqrt(2), 0.0005) << "of a sine";
}

TEST(Relief, MoreThanItsHeightIsRefused)
{
	TReliefOptions o = bumpy();
	o.slope = 0.1;
	EXPECT_HOLDS(errorOf<CError>([&] { makeRelief(o, smallFloor(), 1); }), "make height larger");
}

TEST(Relief, PictureIsLaidNorthUpWhiteIsHighAndItGoesOnBeyond)
{
	const CTempFolder folder;
	cv::Mat1b picture(40, 80, uint8_t(0));
	picture(cv::Rect(40, 0, 40, 20)).setTo(255);  // the north-east quarter
	cv::imwrite(folder / "heights.png", picture);
	TReliefOptions o;
	o.kind = "image", o.image = folder / "heights.png", o.image_width = 8, o.height = 0.5;
	const CReliefSeaFloor floor(makeRelief(o, smallFloor(), 1));
	EXPECT_NEAR(floor.depthAt({1, 2}), kSeaFloor - 0.5, 1e-4) << "white";
	EXPECT_NEAR(floor.depthAt({-1, 2}), kSeaFloor + 0.5, 1e-4);
	EXPECT_NEAR(floor.depthAt({1, -2}), kSeaFloor + 0.5, 1e-4);
	o.kind = "procedural";
	const CReliefSeaFloor beyond(makeRelief(o, smallFloor(), 1));
	for (const Vector2d& p : {Vector2d(5, 5), Vector2d(-3, 6), Vector2d(0, -4.5)})
		EXPECT_EQ(floor.depthAt(p), beyond.depthAt(p)) << "procedural beyond the picture";
	o.kind = "image", o.image = "/nowhere/heights.png";
	EXPECT_HOLDS(errorOf<CError>([&] { makeRelief(o, smallFloor(), 1); }), "/nowhere/heights.png");
}

TEST(Relief, DvlReadsItsAltitudeAndRangesOverTheSlope)
{
	const auto floor = slope();
	CSimulatedDvl sensor("DVL", quietDvl(), quietRanges(), {}, floor, 1);
	const auto beams = quietDvl().beams();
	const Isometry3d T_body_dvl = quietDvl().T_body_sensor();
	for (double t = 10; t < 120; t += 7.9) {
		const TVehicleState state = livelyMotion().at(t);
		const Isometry3d T = state.T_map_body * T_body_dvl;
		const auto o = sensor.measure(state, t);
		const Vector3d head = T.translation();
		EXPECT_NEAR(asDvl(o).altitude, slopeDepth(head.x(), head.y()) - head.z(), 1e-5) << "t=" << t;
		for (int i = 0; i < 4; i++) {
			const Vector3d end = T * (asDvl(o).beam_ranges[i] * beams.col(i));
			EXPECT_NEAR(end.z(), slopeDepth(end.x(), end.y()), 2e-5) << "t=" << t << " beam " << i;
		}
	}
	EXPECT_GT(std::abs(slopeDepth(5, 12) - kSeaFloor), 0.9) << "the route's slope is no level floor";
}
