// Light that falls off towards the corners: its slope is found, and its pull on key points undone.
#include <gtest/gtest.h>
#include <posidonia/geometry/se3.h>
#include <posidonia/vision/key_frame_extractor.h>
#include <posidonia/vision/light_fall.h>

#include <cmath>
#include <random>

#include "floor_renderer.h"

using namespace posidonia;
using posidonia::testing::CFloorRenderer;

namespace
{
double rho2(double u, double v)
{
	return (std::pow(u - 319.5, 2) + std::pow(v - 239.5, 2)) / (320. * 320 + 240 * 240);
}

/** Spots of disparity 14 px all over the picture, contrasts by `slope`, a camera's offset and noise. */
std::vector<CLightFall::TSample> samples(double slope, double noise, int outliers, unsigned seed)
{
	std::mt19937 rng(seed);
	std::normal_distribution<double> n(0, noise);
	std::uniform_real_distribution<double> u(20, 620), v(20, 460);
	std::vector<CLightFall::TSample> all;
	for (int k = 0; k < 400; k++) {
		const double x = u(rng), y = v(rng);
		const double ratio = 0.02 + slope * (rho2(x, y) - rho2(x - 14, y)) + n(rng);
		all.push_back({{x, y, x - 14}, std::exp(k < outliers ? 3 * n(rng) + 0.5 : ratio)});
	}
	return all;
}

/** The picture with its contrast about 115 times exp(slope rho^2). */
cv::Mat darkened(const cv::Mat& image, double slope)
{
	cv::Mat out = image.clone();
	for (int y = 0; y < out.rows; y++)
		for (int x = 0; x < out.cols; x++)
			out.at<uchar>(y, x) =
				cv::saturate_cast<uchar>(115 + (image.at<uchar>(y, x) - 115) * std::exp(slope * rho2(x, y)));
	return out;
}
}  // namespace

TEST(LightFall, findsThePlantedSlope)
{
	const CLightFall fall(640, 480);
	for (const double slope : {-1.0, -0.5, 0.0, 0.3})
		for (unsigned seed = 1; seed < 6; seed++) {
			EXPECT_NEAR(fall.slopeOf(samples(slope, 0.03, 0, seed)), slope, 0.2) << slope << " seed " << seed;
			EXPECT_NEAR(fall.slopeOf(samples(slope, 0.03, 40, seed)), slope, 0.25)
				<< slope << " with outliers, seed " << seed;
		}
}

TEST(LightFall, fewOrUselessSamplesSayNothing)
{
	const CLightFall fall(640, 480);
	EXPECT_EQ(fall.slopeOf({}), 0);
	auto few = samples(-1, 0.03, 0, 1);
	few.resize(8);
	EXPECT_EQ(fall.slopeOf(few), 0);
	EXPECT_LT(std::abs(fall.slopeOf(samples(-1, 1.0, 0, 2))), 0.7) << "noise of a factor of e";
}

TEST(LightFall, pullIsInwardsAndGrowsWithSize)
{
	const CLightFall fall(640, 480);
	EXPECT_LT(fall.pull({319.5, 239.5}, 3, -0.5).norm(), 1e-12);
	const Eigen::Vector2d corner = fall.pull({639, 479}, 1, -0.5);
	EXPECT_LT(corner.x(), 0);
	EXPECT_LT(corner.y(), 0);
	EXPECT_NEAR(fall.pull({639, 479}, 2, -0.5).x(), 4 * corner.x(), 1e-12);
	EXPECT_NEAR(fall.pull({639, 479}, 1, 0.5).x(), -corner.x(), 1e-12);
}

TEST(LightFall, keyPointsOfADarkenedPictureMoveBack)
{
	// The same pair with even light and with light that falls off: the points found in both.
	const CFloorRenderer floor(CFloorRenderer::proceduralTexture(4000, 3), 0.004, TStereoCamera());
	double pulled = 0, corrected = 0, weight = 0;
	for (unsigned seed = 1; seed < 4; seed++) {
		const auto images = floor.render(CFloorRenderer::pose(0.5 * seed, 0, 2.5, seed), 0, seed);
		TFeatureOptions options;
		options.correct_light_fall = false;
		const TStereoCamera camera;
		const TKeyFrame even = CKeyFrameExtractor(options, camera).extract(images.left, images.right);
		const cv::Mat left = darkened(images.left, -0.8), right = darkened(images.right, -0.8);
		const TKeyFrame raw = CKeyFrameExtractor(options, camera).extract(left, right);
		options.correct_light_fall = true;
		const TKeyFrame undone = CKeyFrameExtractor(options, camera).extract(left, right);
		ASSERT_EQ(raw.size(), undone.size());
		for (size_t k = 0; k < raw.size(); k++)
			for (const TStereoPoint& p : even.points) {
				const Eigen::Vector2d at = p.uvr.head<2>(), middle(319.5, 239.5);
				const double limit = 0.25 * std::exp2(p.octave - 1);
				if ((raw.points[k].uvr.head<2>() - at).norm() > limit) continue;
				if (std::abs(raw.points[k].octave - p.octave) > 0.1 || p.octave < 1.5 || p.octave > 3.5)
					continue;
				const Eigen::Vector2d out = (at - middle) * std::exp2(2 * p.octave);  // as the pull goes
				const double w = std::exp2(-4 * p.octave);
				pulled += w * out.dot(raw.points[k].uvr.head<2>() - at);
				corrected += w * out.dot(undone.points[k].uvr.head<2>() - at);
				weight += w * out.squaredNorm();
			}
	}
	ASSERT_GT(weight, 0);
	EXPECT_LT(pulled / weight, -1e-6);
	EXPECT_LT(std::abs(corrected), 0.4 * std::abs(pulled));
	std::printf(
		"[   INFO   ] pull over (octave^4 distance): %.3g, after correction %.3g\n", pulled / weight,
		corrected / weight);
}
