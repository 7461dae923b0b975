#include "floor_renderer.h"

#include <gtest/gtest.h>
#include <posidonia/vision/features.h>
#include <posidonia/vision/key_frame_extractor.h>

using namespace posidonia;
using posidonia::testing::CFloorRenderer;

namespace
{
CFloorRenderer::TPair floorPair(double contrast)
{
	static const CFloorRenderer floor(CFloorRenderer::proceduralTexture(3000, 5), 0.004, TStereoCamera());
	auto pair = floor.render(CFloorRenderer::pose(0.4, -0.3, 2.5, 0.3), 0, 1);
	// Water takes contrast, not brightness.
	for (cv::Mat* m : {&pair.left, &pair.right})
		m->convertTo(*m, CV_8U, contrast, (1 - contrast) * 128);
	return pair;
}

size_t featuresAt(double contrast, const char* detector, double poor_picture)
{
	TFeatureOptions options;
	options.detector = detector;
	options.poor_picture = poor_picture;
	return detectFeatures(floorPair(contrast).left, options).key_points.size();
}
}  // namespace

TEST(PoorPictures, AreEqualisedAndSearchedAgain)
{
	for (const char* detector : {"SIFT", "ORB", "AKAZE"}) {
		SCOPED_TRACE(detector);
		const size_t once = featuresAt(0.15, detector, 0);
		ASSERT_LT(once, 400U) << "the picture is to be a poor one";
		EXPECT_GT(featuresAt(0.15, detector, 0.5), 2 * once + 20);
	}
}

TEST(PoorPictures, GoodOnesAreSearchedOnceOnly)
{
	const auto picture = floorPair(1).left;
	TFeatureOptions once, twice;
	once.poor_picture = 0;
	const auto a = detectFeatures(picture, once), b = detectFeatures(picture, twice);
	ASSERT_GT(a.key_points.size(), 400U);
	ASSERT_EQ(a.key_points.size(), b.key_points.size());
	EXPECT_EQ(cv::norm(a.descriptors, b.descriptors, cv::NORM_L1), 0);
}

TEST(PoorPictures, GiveAKeyFrameThatRegisters)
{
	const auto pair = floorPair(0.15);
	EXPECT_GT(CKeyFrameExtractor({}, TStereoCamera()).extract(pair.left, pair.right).size(), 100U);
}
