#include <gtest/gtest.h>
#include <posidonia/obs/frames.h>
#include <posidonia/sim/random.h>
#include <posidonia/sim/renderer.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

using namespace posidonia;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
constexpr double kDepth = 6, kResolution = 0.005;
const TWaterOptions kClear{0, 0, 0};
const TCameraOptions kPerfect{0, 0};

/** Bright Gaussian blobs at known (north, east) on a dark floor of 16 m x 16 m. */
struct TBlobFloor
{
	static constexpr double kSpacing = 1.0;
	explicit TBlobFloor(double sigma_m)
	{
		cv::Mat grey(3200, 3200, CV_8U, cv::Scalar(20));
		const CFloorTexture empty(grey, kResolution);
		for (int i = -7; i <= 7; i++)
			for (int j = -7; j <= 7; j++) {
				points.push_back({i * kSpacing + 0.0123 * j, j * kSpacing - 0.0071 * i});
				draw(grey, empty.pixelAt(points.back()), sigma_m / kResolution);
			}
		texture = std::make_unique<CFloorTexture>(grey, kResolution);
	}
	static void draw(cv::Mat& grey, const Vector2d& centre, double sigma)
	{
		const int r = static_cast<int>(5 * sigma);
		for (int y = -r; y <= r; y++)
			for (int x = -r; x <= r; x++) {
				const int u = static_cast<int>(centre.x()) + x, v = static_cast<int>(centre.y()) + y;
				const double d2 = (Vector2d(u, v) - centre).squaredNorm() / (2 * sigma * sigma);
				if (u >= 0 && v >= 0 && u < grey.cols && v < grey.rows)
					grey.at<uint8_t>(v, u) = cv::saturate_cast<uint8_t>(20 + 200 * std::exp(-d2));
			}
	}
	std::vector<Vector2d> points;
	std::unique_ptr<CFloorTexture> texture;
};

/** Centroid of the brightness over the background in a window about `guess`. */
Vector2d centroid(const cv::Mat& picture, const Vector2d& guess, int radius)
{
	Vector2d sum(0, 0);
	double weight = 0;
	const int u0 = static_cast<int>(std::lround(guess.x())), v0 = static_cast<int>(std::lround(guess.y()));
	for (int v = v0 - radius; v <= v0 + radius; v++)
		for (int u = u0 - radius; u <= u0 + radius; u++) {
			const double w = picture.at<uint8_t>(v, u) - 20;
			sum += w * Vector2d(u, v);
			weight += w;
		}
	return sum / weight;
}

Isometry3d cameraAt(double north, double east, double down, double yaw, double pitch, double roll)
{
	Isometry3d T = Isometry3d::Identity();
	T.translation() << north, east, down;
	T.linear() = rotationFromYawPitchRoll(yaw, pitch, roll) * downLookingCamera();
	return T;
}

/** Largest error [px] of all blobs in the left and the right picture; counts them. */
struct TErrors
{
	double largest{0}, mean_u{0}, mean_v{0};
	int count{0};
};
void compare(const cv::Mat& picture, const Vector2d& expected, int radius, TErrors& errors)
{
	if (expected.x() < radius + 2 || expected.y() < radius + 2 || expected.x() > picture.cols - radius - 3 ||
		expected.y() > picture.rows - radius - 3)
		return;
	const Vector2d off = centroid(picture, expected, radius) - expected;
	errors.largest = std::max(errors.largest, off.norm());
	errors.mean_u += off.x(), errors.mean_v += off.y();
	errors.count++;
}
TErrors blobErrors(const TBlobFloor& floor, const Isometry3d& T_map_camera, double sigma_m)
{
	const TStereoCamera camera;
	const CFloorRenderer renderer(*floor.texture, kDepth, camera, kClear, kPerfect);
	const TGreyPair pair = renderPair(renderer, T_map_camera, camera.baseline, 1, 0);
	const int radius =
		static_cast<int>(5 * sigma_m * camera.fx / (kDepth - T_map_camera.translation().z())) + 2;
	TErrors errors;
	for (const auto& p : floor.points) {
		const Vector3d uvr = camera.project(T_map_camera.inverse() * Vector3d(p.x(), p.y(), kDepth));
		compare(pair.left, {uvr.x(), uvr.y()}, radius, errors);
		compare(pair.right, {uvr.z(), uvr.y()}, radius, errors);
	}
	errors.mean_u /= errors.count, errors.mean_v /= errors.count;
	return errors;
}
}  // namespace

/** Heights over which mip levels 0 to 2 and the blends between them are used. */
class RendererGeometry : public ::testing::TestWithParam<double>
{
};

TEST_P(RendererGeometry, FloorPointsAppearWhereThePinHoleSaysInBothEyes)
{
	const double height = GetParam(), sigma = std::clamp(0.016 * height, 0.019, 0.07);
	const TBlobFloor floor(sigma);
	const Isometry3d poses[] = {
		cameraAt(0, 0, kDepth - height, 0, 0, 0), cameraAt(0.31, -0.22, kDepth - height, 1.1, 0.03, -0.02),
		cameraAt(-0.4, 0.57, kDepth - height, -2.3, -0.04, 0.05)};
	int count = 0;
	for (const auto& T_map_camera : poses) {
		const TErrors e = blobErrors(floor, T_map_camera, sigma);
		EXPECT_LT(e.largest, 0.05) << "height " << height;
		// Half a pixel of a level would show as 0.2 px and more; a tilted view moves a blob's centroid by
		// 0.02 px.
		EXPECT_LT(std::hypot(e.mean_u, e.mean_v), count == 0 ? 0.01 : 0.03) << "height " << height;
		count += e.count;
	}
	EXPECT_GE(count, 6);
}
INSTANTIATE_TEST_SUITE_P(
	Heights, RendererGeometry, ::testing::Values(1.1, 1.42, 2.0, 2.4, 2.83, 4.0, 5.65, 5.9));

TEST(Renderer, TopOfTheImageIsTheBowAndTheRightIsStarboard)
{
	cv::Mat grey(3200, 3200, CV_8U, cv::Scalar(20));
	const CFloorTexture empty(grey, kResolution);
	TBlobFloor::draw(grey, empty.pixelAt({1.0, 0.0}), 8);  // north
	TBlobFloor::draw(grey, empty.pixelAt({0.0, 1.5}), 8);  // east
	const CFloorTexture floor(grey, kResolution);
	const TStereoCamera camera;
	const CFloorRenderer renderer(floor, kDepth, camera, kClear, kPerfect);
	const cv::Mat heading_north = renderer.render(cameraAt(0, 0, 3.5, 0, 0, 0), 1);
	const int north = static_cast<int>(239.5 - 283 / 2.5), east = static_cast<int>(319.5 + 283 * 1.5 / 2.5);
	EXPECT_GT(heading_north.at<uint8_t>(north, 320), 150);
	EXPECT_GT(heading_north.at<uint8_t>(240, east), 150);
	EXPECT_LT(heading_north.at<uint8_t>(480 - north, 320), 30);
	const cv::Mat heading_east = renderer.render(cameraAt(0, 0, 3.5, M_PI / 2, 0, 0), 1);
	EXPECT_GT(heading_east.at<uint8_t>(240, 320 - 113), 150) << "north is to port";
}

TEST(Renderer, DisparityIsFocalLengthTimesBaselineOverRange)
{
	TFloorOptions rock;
	rock.texture = "rock", rock.extent_north = rock.extent_east = 12;
	const CFloorTexture floor(rock, 1);
	const TStereoCamera camera;
	const CFloorRenderer renderer(floor, kDepth, camera, kClear, kPerfect);
	for (const int disparity : {8, 12, 15, 17}) {
		// Above a level floor both eyes see the same, whole pixels apart at these heights.
		const double height = camera.fx * camera.baseline / disparity;
		const TGreyPair pair =
			renderPair(renderer, cameraAt(0, 0, kDepth - height, 0.4, 0, 0), camera.baseline, 1, 0);
		const int width = camera.width - disparity;
		const cv::Mat left = pair.left(cv::Rect(disparity, 0, width, camera.height));
		const cv::Mat right = pair.right(cv::Rect(0, 0, width, camera.height));
		EXPECT_LE(cv::norm(left, right, cv::NORM_INF), 1) << "disparity " << disparity;
		EXPECT_GT(cv::norm(pair.left, pair.right, cv::NORM_INF), 30) << "disparity " << disparity;
	}
}

TEST(Renderer, LevelsBlendWithoutAStep)
{
	TFloorOptions rock;
	rock.texture = "rock", rock.extent_north = rock.extent_east = 14;
	const CFloorTexture floor(rock, 1);
	const TStereoCamera camera;
	const CFloorRenderer renderer(floor, kDepth, camera, kClear, kPerfect);
	for (const double level : {1.0, 2.0}) {
		const double height = kResolution * std::pow(2.0, level) * camera.fx;
		const cv::Mat below = renderer.render(cameraAt(0, 0, kDepth - height * (1 - 1e-7), 0, 0, 0), 1);
		const cv::Mat above = renderer.render(cameraAt(0, 0, kDepth - height * (1 + 1e-7), 0, 0, 0), 1);
		EXPECT_LE(cv::norm(below, above, cv::NORM_INF), 1) << "level " << level;
	}
}

TEST(Renderer, WaterFollowsItsLawByRange)
{
	const CFloorTexture floor(cv::Mat(3200, 3200, CV_8U, cv::Scalar(180)), kResolution);
	const TWaterOptions water{0.2, 0.3, 90};
	const TStereoCamera camera;
	const CFloorRenderer renderer(floor, kDepth, camera, water, kPerfect);
	const cv::Mat picture = renderer.render(cameraAt(0, 0, 2.0, 0, 0, 0), 1);
	for (const cv::Point p : {cv::Point(320, 240), cv::Point(0, 0), cv::Point(639, 479), cv::Point(100, 400)})
	{
		const double range =
			4 * Vector3d((p.x - camera.cx) / camera.fx, (p.y - camera.cy) / camera.fy, 1).norm();
		const double grey = 180 * std::exp(-0.2 * range) + 90 * (1 - std::exp(-0.3 * range));
		EXPECT_NEAR(picture.at<uint8_t>(p), grey, 0.7) << p;
	}
}

TEST(Renderer, VignettingDarkensTheCorners)
{
	const CFloorTexture floor(cv::Mat(3200, 3200, CV_8U, cv::Scalar(200)), kResolution);
	const CFloorRenderer renderer(floor, kDepth, TStereoCamera(), kClear, {0, 0.4});
	const cv::Mat picture = renderer.render(cameraAt(0, 0, 3.5, 0, 0, 0), 1);
	EXPECT_NEAR(picture.at<uint8_t>(240, 320), 200, 1);
	EXPECT_NEAR(picture.at<uint8_t>(0, 0), 120, 1);
}

TEST(Renderer, NoiseIsWhiteSeededAndItsOwnInEachEyeAndFrame)
{
	const CFloorTexture floor(cv::Mat(3200, 3200, CV_8U, cv::Scalar(100)), kResolution);
	const TStereoCamera camera;
	const CFloorRenderer renderer(floor, kDepth, camera, kClear, {3, 0});
	const Isometry3d pose = cameraAt(0, 0, 3.5, 0, 0, 0);
	const TGreyPair a = renderPair(renderer, pose, 0.12, 5, 1),
					again = renderPair(renderer, pose, 0.12, 5, 1);
	const TGreyPair next = renderPair(renderer, pose, 0.12, 5, 2),
					other = renderPair(renderer, pose, 0.12, 6, 1);
	EXPECT_EQ(cv::norm(a.left, again.left, cv::NORM_INF) + cv::norm(a.right, again.right, cv::NORM_INF), 0);
	cv::Scalar mean, sigma;
	cv::meanStdDev(a.left, mean, sigma);
	EXPECT_NEAR(mean[0], 100, 0.05);
	EXPECT_NEAR(sigma[0], std::sqrt(9 + 1.0 / 12), 0.03);
	const cv::Mat pictures[] = {a.left, a.right, next.left, other.left};
	for (int i = 1; i < 4; i++) {
		cv::Mat x, y;
		pictures[0].convertTo(x, CV_64F);
		pictures[i].convertTo(y, CV_64F);
		const double correlation = ((x - 100).dot(y - 100)) / static_cast<double>(x.total()) / 9;
		EXPECT_NEAR(correlation, 0, 0.01) << "picture " << i;
	}
	cv::Mat x;
	a.left.convertTo(x, CV_64F);
	const cv::Rect here(0, 0, 639, 480), beside(1, 0, 639, 480);
	EXPECT_NEAR((x(here) - 100).dot(x(beside) - 100) / 639 / 480 / 9, 0, 0.01) << "neighbouring pixels";
}

TEST(Renderer, ClearAboveTheHorizon)
{
	const CFloorTexture floor(cv::Mat(3200, 3200, CV_8U, cv::Scalar(200)), kResolution);
	const CFloorRenderer renderer(floor, kDepth, TStereoCamera(), {0.3, 0.3, 60}, kPerfect);
	const cv::Mat picture = renderer.render(cameraAt(0, 0, 3.5, 0, M_PI / 2, 0), 1);  // looks along north
	EXPECT_NEAR(picture.at<uint8_t>(0, 320), 60, 1) << "endless water";
	EXPECT_GT(picture.at<uint8_t>(479, 320), 70) << "floor";
}
