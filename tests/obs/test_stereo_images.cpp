#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <temp_folder.h>

#include <opencv2/imgcodecs.hpp>

#include "sample_observations.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
TStereoSpec smallRig()
{
	TStereoSpec spec;
	spec.camera = {32, 24, 20.5, 21.5, 15.25, 11.75, 0.12};
	return spec;
}

void writePicture(const CTempFolder& folder, const std::string& name, const cv::Mat& picture)
{
	std::filesystem::create_directories(folder / "dive_Images");
	ASSERT_TRUE(cv::imwrite(folder / ("dive_Images/" + name), picture));
}
}  // namespace

TEST(StereoImages, TheRigComesBackFromTheObservation)
{
	const TStereoSpec spec = smallRig();
	const TStereoSpec back = stereoSpecOf(*makeStereo("STEREO", 1e9, spec, "l.png", "r.png"));
	EXPECT_EQ(back.camera.width, 32);
	EXPECT_EQ(back.camera.height, 24);
	EXPECT_EQ(back.camera.fx, 20.5);
	EXPECT_EQ(back.camera.fy, 21.5);
	EXPECT_EQ(back.camera.cx, 15.25);
	EXPECT_EQ(back.camera.cy, 11.75);
	EXPECT_DOUBLE_EQ(back.camera.baseline, 0.12);
	EXPECT_LT((back.T_body_sensor().matrix() - spec.T_body_sensor().matrix()).norm(), 1e-12);
}

TEST(StereoImages, WhatIsNotRectifiedIsRefused)
{
	auto pair = makeStereo("STEREO", 1e9, smallRig(), "l.png", "r.png");
	pair->leftCamera.dist[0] = -0.2;
	EXPECT_HOLDS(errorOf<CError>([&] { stereoSpecOf(*pair); }), "sensor 'STEREO'");
	pair = makeStereo("STEREO", 1e9, smallRig(), "l.png", "r.png");
	pair->rightCamera.setIntrinsicParamsFromValues(20.5, 21.5, 17, 11.75);
	EXPECT_HOLDS(errorOf<CError>([&] { stereoSpecOf(*pair); }), "differ");
	TStereoSpec swapped = smallRig();
	swapped.camera.baseline = -0.12;
	pair = makeStereo("STEREO", 1e9, swapped, "l.png", "r.png");
	EXPECT_HOLDS(errorOf<CError>([&] { stereoSpecOf(*pair); }), "baseline");
	pair = makeStereo("STEREO", 1e9, smallRig(), "l.png", "r.png");
	pair->hasImageRight = false;
	EXPECT_HOLDS(errorOf<CError>([&] { stereoSpecOf(*pair); }), "no right image");
}

TEST(StereoImages, PicturesBesideTheRawlogAreReadGrey)
{
	CTempFolder folder;
	writePicture(folder, "l.png", cv::Mat(24, 32, CV_8UC1, cv::Scalar(17)));
	writePicture(folder, "r.png", cv::Mat(24, 32, CV_8UC3, cv::Scalar(90, 90, 90)));
	const CStereoImageLoader loader(folder / "dive.rawlog");
	EXPECT_EQ(loader.folder(), folder / "dive_Images");
	const TGreyPair pictures = loader.load(*makeStereo("STEREO", 1e9, smallRig(), "l.png", "r.png"));
	EXPECT_EQ(pictures.left.type(), CV_8UC1);
	EXPECT_EQ(pictures.left.at<uchar>(3, 4), 17);
	EXPECT_EQ(pictures.right.type(), CV_8UC1);
	EXPECT_EQ(pictures.right.at<uchar>(3, 4), 90);
}

TEST(StereoImages, EmbeddedPicturesAreUsed)
{
	auto pair = makeStereo("STEREO", 1e9, smallRig(), "l.png", "r.png");
	pair->imageLeft = mrpt::img::CImage(cv::Mat(24, 32, CV_8UC1, cv::Scalar(5)), mrpt::img::DEEP_COPY);
	pair->imageRight = mrpt::img::CImage(cv::Mat(24, 32, CV_8UC3, cv::Scalar(7, 7, 7)), mrpt::img::DEEP_COPY);
	const TGreyPair pictures = CStereoImageLoader("dive.rawlog").load(*pair);
	EXPECT_EQ(pictures.left.at<uchar>(0, 0), 5);
	EXPECT_EQ(pictures.right.type(), CV_8UC1);
	EXPECT_EQ(pictures.right.at<uchar>(0, 0), 7);
}

TEST(StereoImages, AMissingPictureIsNamedWithItsSideStampAndFolder)
{
	CTempFolder folder;
	writePicture(folder, "l.png", cv::Mat(24, 32, CV_8UC1, cv::Scalar(17)));
	const CStereoImageLoader loader(folder / "dive.rawlog");
	const auto pair = makeStereo("STEREO", 1e9, smallRig(), "l.png", "r_000012.png");
	const std::string problem = errorOf<CError>([&] { loader.load(*pair); });
	EXPECT_HOLDS(
		problem, "dive.rawlog: stereo pair at 1000000000.000000 s: right image r_000012.png not found");
	EXPECT_HOLDS(problem, "dive_Images/");
}
