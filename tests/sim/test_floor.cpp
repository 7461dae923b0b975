#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/sim/floor.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "temp_folder.h"

using namespace posidonia;
using posidonia::testing::CTempFolder;
using posidonia::testing::errorOf;

namespace
{
const std::string kReef = std::string(POSIDONIA_SOURCE_DIR) + "/ini/textures/noaa_reef.jpg";
const std::string kRock = std::string(POSIDONIA_SOURCE_DIR) + "/ini/textures/rock053.jpg";

TFloorOptions coarse(const std::string& texture)
{
	TFloorOptions o;
	o.texture = texture, o.image = kReef, o.resolution = 0.02;
	return o;
}
bool same(const cv::Mat& a, const cv::Mat& b)
{
	return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

/** Largest normalised cross-correlation of a patch with a region. */
double bestMatch(const cv::Mat& patch, const cv::Mat& region)
{
	cv::Mat score;
	cv::matchTemplate(region, patch, score, cv::TM_CCOEFF_NORMED);
	double best = 0;
	cv::minMaxLoc(score, nullptr, &best);
	return best;
}
}  // namespace

TEST(Floor, SeedDecidesTheTexture)
{
	for (const char* kind : {"photo", "sand", "rock"}) {
		const CFloorTexture a(coarse(kind), 1), b(coarse(kind), 1), c(coarse(kind), 2);
		EXPECT_TRUE(same(a.levels()[0], b.levels()[0])) << kind;
		EXPECT_FALSE(same(a.levels()[0], c.levels()[0])) << kind;
	}
}

TEST(Floor, PhotographLiesNorthUpInTheMiddle)
{
	const CFloorTexture floor(coarse("photo"), 1);
	cv::Mat photo = cv::imread(kReef, cv::IMREAD_GRAYSCALE);
	const double scale = 30 / 0.02 / photo.cols;
	cv::resize(photo, photo, {}, scale, scale, cv::INTER_AREA);
	// A patch 9 m west and 6 m north of the middle of the photograph lies there on the floor.
	const cv::Rect in_photo(photo.cols / 2 - 450, photo.rows / 2 - 300, 100, 80);
	const Eigen::Vector2d corner = floor.pixelAt({6, -9});
	const cv::Rect on_floor(
		static_cast<int>(std::lround(corner.x())), static_cast<int>(std::lround(corner.y())), 100, 80);
	EXPECT_LE(cv::norm(photo(in_photo), floor.levels()[0](on_floor), cv::NORM_L1) / on_floor.area(), 4);
	EXPECT_GT(bestMatch(floor.levels()[0](on_floor), photo), 0.99);
}

TEST(Floor, BeyondThePhotographNothingRepeats)
{
	const CFloorTexture floor(coarse("photo"), 1);
	const cv::Mat& all = floor.levels()[0];
	const cv::Mat photo = all(cv::Rect(250, 250, 1500, 1000));
	const cv::Mat west = all(cv::Rect(0, 0, 240, all.rows)),
				  east = all(cv::Rect(all.cols - 240, 0, 240, all.rows));
	for (const int y : {100, 700, 1200}) {
		const cv::Mat patch = west(cv::Rect(60, y, 120, 120));
		cv::Mat flipped;
		for (const int code : {-1, 0, 1}) {
			cv::flip(patch, flipped, code);
			EXPECT_LT(bestMatch(flipped, west), 0.8) << "mirrored, y=" << y;
			EXPECT_LT(bestMatch(flipped, photo), 0.8) << "mirrored photograph, y=" << y;
		}
		EXPECT_LT(bestMatch(patch, photo), 0.8) << "y=" << y;
		EXPECT_LT(bestMatch(patch, east), 0.8) << "y=" << y;
	}
}

TEST(Floor, BeyondThePhotographMeanAndContrastGoOn)
{
	const CFloorTexture floor(coarse("photo"), 1);
	const cv::Mat& all = floor.levels()[0];
	cv::Scalar mean_in, mean_out, sigma_in, sigma_out;
	cv::meanStdDev(all(cv::Rect(250, 250, 1500, 1000)), mean_in, sigma_in);
	cv::meanStdDev(all(cv::Rect(0, 0, all.cols, 240)), mean_out, sigma_out);
	EXPECT_NEAR(mean_out[0], mean_in[0], 12);
	EXPECT_NEAR(sigma_out[0] / sigma_in[0], 1, 0.25);
}

TEST(Floor, SandIsPoorRockIsRich)
{
	cv::Scalar mean, sand, rock;
	cv::meanStdDev(CFloorTexture(coarse("sand"), 1).levels()[0], mean, sand);
	EXPECT_NEAR(mean[0], 115, 2);
	cv::meanStdDev(CFloorTexture(coarse("rock"), 1).levels()[0], mean, rock);
	EXPECT_NEAR(mean[0], 115, 3);
	EXPECT_GT(sand[0], 3);
	EXPECT_LT(sand[0], 15);
	EXPECT_GT(rock[0], 1.8 * sand[0]);
}

TEST(Floor, TiledRepeatsExactly)
{
	TFloorOptions o = coarse("tiled");
	o.image = kRock, o.image_width = 2;
	const CFloorTexture floor(o, 1);
	const cv::Mat& all = floor.levels()[0];
	EXPECT_TRUE(same(all(cv::Rect(0, 0, 200, 200)), all(cv::Rect(600, 400, 200, 200))));
}

TEST(Floor, ContrastIsScaledAboutTheMean)
{
	TFloorOptions o = coarse("sand");
	const cv::Mat full = CFloorTexture(o, 1).levels()[0];
	o.contrast = 0.5;
	const cv::Mat half = CFloorTexture(o, 1).levels()[0];
	cv::Scalar mean, a, b;
	cv::meanStdDev(full, mean, a);
	cv::meanStdDev(half, mean, b);
	EXPECT_NEAR(b[0] / a[0], 0.5, 0.03);
}

TEST(Floor, LevelsAverageTwoByTwo)
{
	const CFloorTexture floor(coarse("rock"), 1);
	for (size_t n = 1; n < floor.levels().size(); n++) {
		const cv::Mat &fine = floor.levels()[n - 1], &level = floor.levels()[n];
		ASSERT_EQ(level.cols * 2, fine.cols);
		ASSERT_EQ(level.rows * 2, fine.rows);
		for (const cv::Point p :
			 {cv::Point(0, 0), cv::Point(7, 3), cv::Point(level.cols - 1, level.rows - 1)})
			EXPECT_NEAR(cv::mean(fine(cv::Rect(2 * p.x, 2 * p.y, 2, 2)))[0], level.at<uint8_t>(p), 0.51) << p;
	}
}

TEST(Floor, ErrorsNameThePictureAndTheWayOut)
{
	TFloorOptions o = coarse("photo");
	o.image = "/nowhere/reef.jpg";
	EXPECT_HOLDS(errorOf<CError>([&] { CFloorTexture(o, 1); }), "/nowhere/reef.jpg");
	const CTempFolder folder;
	o.image = folder.write("no.jpg", "text");
	EXPECT_HOLDS(errorOf<CError>([&] { CFloorTexture(o, 1); }), "no picture");
}
