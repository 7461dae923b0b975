#include "floor_renderer.h"

#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/geometry/se3.h>
#include <posidonia/vision/key_frame_extractor.h>
#include <posidonia/vision/stereo_registration.h>

#include <algorithm>
#include <cmath>

using namespace posidonia;
using Eigen::Isometry3d;
using posidonia::testing::CFloorRenderer;

namespace
{
constexpr double DEG = M_PI / 180;
constexpr double NOISE = 3;	 // [grey levels]

const CFloorRenderer& floorOfNoise()
{
	static const CFloorRenderer renderer(CFloorRenderer::proceduralTexture(4000, 3), 0.004, TStereoCamera());
	return renderer;
}

TKeyFrame keyFrame(
	const CFloorRenderer& floor, const Isometry3d& T, unsigned seed, const TFeatureOptions& options = {})
{
	const auto images = floor.render(T, NOISE, seed);
	return CKeyFrameExtractor(options, TStereoCamera()).extract(images.left, images.right);
}

bool identical(const TKeyFrame& a, const TKeyFrame& b)
{
	if (a.size() != b.size() || cv::norm(a.descriptors, b.descriptors, cv::NORM_L1) != 0) return false;
	for (size_t i = 0; i < a.size(); i++)
		if (a.points[i].uvr != b.points[i].uvr || a.points[i].sigma_d != b.points[i].sigma_d) return false;
	return true;
}

double median(std::vector<double> v)
{
	std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
	return v[v.size() / 2];
}

/** Registrations among views of one spot: headings all round, altitudes, tilts. */
struct TStudy
{
	int pairs{0}, accepted{0}, wrong{0};
	std::vector<double> chi2, millimetres, milliradians;

	void add(const CFloorRenderer& floor, double x, double y, int views, unsigned seed)
	{
		const CStereoRegistration registration({}, TStereoCamera());
		std::mt19937 rng(seed);
		std::uniform_real_distribution<double> unit(-1, 1);
		std::vector<Isometry3d> poses;
		std::vector<TKeyFrame> frames;
		for (int i = 0; i < views; i++) {
			const double dx = 0.4 * unit(rng), dy = 0.4 * unit(rng), altitude = 2.5 * (1 + 0.1 * unit(rng));
			const double yaw = 45 * DEG * i + 0.2 * unit(rng), pitch = 5 * DEG * unit(rng),
						 roll = 5 * DEG * unit(rng);
			poses.push_back(CFloorRenderer::pose(x + dx, y + dy, altitude, yaw, pitch, roll));
			frames.push_back(keyFrame(floor, poses.back(), 100 * seed + i));
		}
		for (int i = 0; i < views; i++)
			for (int j = i + 1; j < views; j++)
				compare(registration.align(frames[i], frames[j], i), poses[i].inverse() * poses[j]);
	}

	void compare(const TRegistration& r, const Isometry3d& truth)
	{
		pairs++;
		if (!r.accepted()) return;
		accepted++;
		const Vector6d e = localCoordinates(r.T_a_b, truth);
		wrong += e.head<3>().norm() > 0.3 || e.tail<3>().norm() > 5 * DEG;
		chi2.push_back(e.dot(r.information * e));
		millimetres.push_back(1e3 * e.head<3>().norm());
		milliradians.push_back(1e3 * e.tail<3>().norm());
	}

	double meanChi2Over6() const
	{
		double sum = 0;
		for (const double x : chi2)
			sum += x / 6;
		return sum / static_cast<double>(chi2.size());
	}
};
}  // namespace

TEST(KeyFrame, pointsLieOnTheFloorWithinTheirNoise)
{
	const TStereoCamera camera;
	const Isometry3d T = CFloorRenderer::pose(0.3, -0.2, 2.5, 0.7, 4 * DEG, -3 * DEG);
	const TKeyFrame frame = keyFrame(floorOfNoise(), T, 1);
	ASSERT_GT(frame.size(), 300u);
	std::vector<double> pixels, sigmas;
	for (const TStereoPoint& p : frame.points) {
		const Eigen::Vector3d ray = p.point / p.point.z();
		const double depth = -T.translation().z() / (T.linear() * ray).z();
		const double error = p.uvd().z() - camera.fx * camera.baseline / depth;
		pixels.push_back(std::abs(error));
		sigmas.push_back(std::abs(error) / p.sigma_d);
		EXPECT_LT((camera.project(p.point) - p.uvr).norm(), 1e-9);
	}
	EXPECT_LT(median(pixels), 0.05);
	EXPECT_NEAR(median(sigmas), 0.6745, 0.2);  // median of |N(0, 1)|
}

TEST(KeyFrame, sameWhateverTheThreads)
{
	const auto images = floorOfNoise().render(CFloorRenderer::pose(0, 0, 2.5, 0.3), NOISE, 2);
	for (const char* detector : {"SIFT", "ORB", "AKAZE"}) {
		TFeatureOptions options;
		options.detector = detector;
		const CKeyFrameExtractor extractor(options, TStereoCamera());
		const TKeyFrame two = extractor.extract(images.left, images.right);
		cv::setNumThreads(1);
		const TKeyFrame one = extractor.extract(images.left, images.right);
		cv::setNumThreads(-1);
		EXPECT_TRUE(identical(one, two)) << detector;
		EXPECT_GT(one.size(), 100u) << detector;
		EXPECT_LE(one.detected_left, options.max_features) << detector;
		EXPECT_LT(one.bytes(), one.size() * 330) << detector;
	}
}

TEST(KeyFrame, blackAndFlatImagesGiveNoPoints)
{
	for (const int grey : {0, 128})
		for (const char* detector : {"SIFT", "ORB", "AKAZE"}) {
			TFeatureOptions options;
			options.detector = detector;
			const cv::Mat image(480, 640, CV_8U, cv::Scalar(grey));
			const TKeyFrame frame = CKeyFrameExtractor(options, TStereoCamera()).extract(image, image);
			EXPECT_EQ(frame.size(), 0u) << detector << " " << grey;
			const CStereoRegistration registration({}, TStereoCamera());
			EXPECT_EQ(registration.align(frame, frame).status, ERegistrationStatus::TOO_FEW_POINTS);
		}
}

TEST(KeyFrame, wrongImagesAndOptionsAreRefused)
{
	const CKeyFrameExtractor extractor({}, TStereoCamera());
	const cv::Mat good(480, 640, CV_8U), small(240, 320, CV_8U), colour(480, 640, CV_8UC3);
	EXPECT_THROW(extractor.extract(good, small), CError);
	EXPECT_THROW(extractor.extract(colour, good), CError);
	TFeatureOptions options;
	options.max_depth = options.min_depth;
	EXPECT_THROW(CKeyFrameExtractor(options, TStereoCamera()), CError);
}

TEST(KeyFrame, claheFindsMoreInTurbidWater)
{
	auto images = floorOfNoise().render(CFloorRenderer::pose(0, 0, 2.5, 0.3), 0, 2);
	for (cv::Mat* image : {&images.left, &images.right})
		image->convertTo(*image, CV_8U, 0.1, 100);
	TFeatureOptions raw, equalised;
	equalised.clahe = true;
	raw.poor_picture = 0;  // never equalised
	const TStereoCamera camera;
	EXPECT_GT(
		CKeyFrameExtractor(equalised, camera).extract(images.left, images.right).size(),
		CKeyFrameExtractor(raw, camera).extract(images.left, images.right).size() + 20);
}

TEST(RenderedRegistration, errorsMatchTheirInformation)
{
	TStudy study;
	study.add(floorOfNoise(), 0, 0, 9, 1);
	const CFloorRenderer reef(
		CFloorRenderer::reefPhotograph(), CFloorRenderer::kMetresPerPixel, TStereoCamera());
	study.add(reef, 2, 1, 9, 2);
	ASSERT_GE(study.pairs, 60);
	EXPECT_EQ(study.accepted, study.pairs);
	EXPECT_EQ(study.wrong, 0);
	EXPECT_GT(study.meanChi2Over6(), 0.8);
	EXPECT_LT(study.meanChi2Over6(), 1.25);
	EXPECT_LT(median(study.millimetres), 1.5);
	EXPECT_LT(median(study.milliradians), 0.5);
}

TEST(RenderedRegistration, placesThatDoNotOverlapAreRefused)
{
	const CStereoRegistration registration({}, TStereoCamera());
	std::vector<TKeyFrame> frames;
	for (int i = 0; i < 3; i++)
		frames.push_back(keyFrame(floorOfNoise(), CFloorRenderer::pose(0, 4.8 * (i - 1), 2.2, i), 30 + i));
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++) {
			if (i == j) continue;
			EXPECT_FALSE(registration.align(frames[i], frames[j]).accepted()) << i << " " << j;
		}
}
