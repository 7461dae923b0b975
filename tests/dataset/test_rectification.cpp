#include <gtest/gtest.h>
#include <posidonia/dataset/stereo_rectifier.h>
#include <posidonia/geometry/se3.h>
#include <posidonia/obs/observations.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "sample_dataset.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector3d;

namespace
{
TRawCamera rawCamera(double f, const Eigen::Isometry3d& T_BS, std::vector<double> distortion)
{
	return {320, 240, f, f + 1, 160, 118, std::move(distortion), T_BS, 10};
}

Eigen::Isometry3d pose(const Vector3d& t, const Vector3d& phi)
{
	Vector6d d;
	d << t, phi;
	return retract(Eigen::Isometry3d::Identity(), d);
}

std::string dataFolder()
{
	const char* set = std::getenv("POSIDONIA_DATA");
	return set ? set : std::string(POSIDONIA_SOURCE_DIR) + "/../shared/data";
}

/** Row differences [px] of SIFT matches that pass the ratio test in both directions. */
std::vector<double> rowDifferences(const TGreyPair& pictures)
{
	const auto sift = cv::SIFT::create(1000);
	std::vector<cv::KeyPoint> keys[2];
	cv::Mat descriptors[2];
	sift->detectAndCompute(pictures.left, {}, keys[0], descriptors[0]);
	sift->detectAndCompute(pictures.right, {}, keys[1], descriptors[1]);
	std::vector<std::vector<cv::DMatch>> there, back;
	const cv::BFMatcher matcher(cv::NORM_L2);
	matcher.knnMatch(descriptors[0], descriptors[1], there, 2);
	matcher.knnMatch(descriptors[1], descriptors[0], back, 1);
	std::vector<double> dv;
	for (const auto& m : there)
		if (m.size() == 2 && m[0].distance < 0.75f * m[1].distance &&
			back[size_t(m[0].trainIdx)][0].trainIdx == m[0].queryIdx)
			dv.push_back(std::abs(keys[0][size_t(m[0].queryIdx)].pt.y - keys[1][size_t(m[0].trainIdx)].pt.y));
	return dv;
}

/** Bilinear value of a float picture. */
double valueAt(const cv::Mat& image, const Vector3d& at)
{
	const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
	const double a = at.x() - x, b = at.y() - y;
	const auto v = [&](int c, int r) { return double(image.at<float>(r, c)); };
	return (1 - b) * ((1 - a) * v(x, y) + a * v(x + 1, y)) +
		   b * ((1 - a) * v(x, y + 1) + a * v(x + 1, y + 1));
}

double median(std::vector<double> values)
{
	std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
	return values[values.size() / 2];
}
}  // namespace

TEST(Rectifier, AlignedCamerasPassUnchanged)
{
	const auto right = pose({0.12, 0, 0}, Vector3d::Zero());
	const CStereoRectifier r(
		rawCamera(200, Eigen::Isometry3d::Identity(), {0, 0, 0, 0}), rawCamera(200, right, {0, 0, 0, 0}),
		false, "x");
	EXPECT_TRUE(r.isIdentity());
	EXPECT_EQ(r.camera().baseline, 0.12);
	EXPECT_EQ(r.rotation(), Eigen::Matrix3d::Identity());
	for (const auto& T : {pose({0.12, 0, 0}, {0, 0, 1e-3}), pose({0.12, 1e-4, 0}, Vector3d::Zero())})
		EXPECT_FALSE(CStereoRectifier(
						 rawCamera(200, Eigen::Isometry3d::Identity(), {0, 0, 0, 0}),
						 rawCamera(200, T, {0, 0, 0, 0}), false, "x")
						 .isIdentity());
}

/** A bright spot at the raw projection of a point must come out where the rectified rig projects that point.
 */
TEST(Rectifier, APointComesOutWhereTheRectifiedRigProjectsIt)
{
	const std::vector<double> k{-0.2, 0.05, 1e-3, -5e-4};
	const Eigen::Isometry3d T_B_left = pose({0.1, 0.2, 0.3}, {0.3, -0.2, 0.1});
	const Eigen::Isometry3d T_left_right = pose({0.12, 0.004, -0.003}, {0.02, -0.03, 0.01});
	const TRawCamera cameras[] = {rawCamera(200, T_B_left, k), rawCamera(205, T_B_left * T_left_right, k)};
	cv::Mat columns(240, 320, CV_32FC1), rows(240, 320, CV_32FC1);	// each pixel holds its own place
	for (int y = 0; y < 240; y++)
		for (int x = 0; x < 320; x++) {
			columns.at<float>(y, x) = float(x);
			rows.at<float>(y, x) = float(y);
		}
	for (bool cubic : {false, true}) {
		const CStereoRectifier rectifier(cameras[0], cameras[1], cubic, "x");
		// OpenCV's maps have steps of 1/32 px; its cubic kernel (a = -0.75) does not reproduce a ramp
		const double tolerance = cubic ? 0.06 : 0.02;
		EXPECT_NEAR(rectifier.camera().baseline, T_left_right.translation().norm(), 1e-12);
		for (const Vector3d& p : {Vector3d(0, 0, 2), Vector3d(0.5, 0.3, 2.2), Vector3d(-0.6, -0.4, 1.8)}) {
			const Vector3d in_rectified = rectifier.rotation().transpose() * p;
			const Vector3d uvr = rectifier.camera().project(in_rectified);
			for (int side = 0; side < 2; side++) {
				const Vector3d c = side ? Vector3d(T_left_right.inverse() * p) : p;
				std::vector<cv::Point2d> raw;
				const cv::Mat K =
					(cv::Mat_<double>(3, 3) << cameras[side].fu, 0, 160, 0, cameras[side].fv, 118, 0, 0, 1);
				cv::projectPoints(
					std::vector<cv::Point3d>{{c.x(), c.y(), c.z()}}, cv::Mat::zeros(3, 1, CV_64F),
					cv::Mat::zeros(3, 1, CV_64F), K, k, raw);
				const Vector3d at(side ? uvr.z() : uvr.x(), uvr.y(), 0);
				EXPECT_NEAR(valueAt(rectifier.rectified(columns, side == 1), at), raw[0].x, tolerance)
					<< p.transpose() << " side=" << side << " cubic=" << cubic;
				EXPECT_NEAR(valueAt(rectifier.rectified(rows, side == 1), at), raw[0].y, tolerance)
					<< p.transpose() << " side=" << side << " cubic=" << cubic;
			}
		}
	}
}

TEST(Rectifier, RealEurocPairsHaveAlignedRows)
{
	const std::string input = dataFolder() + "/stereo-euroc";
	if (!std::filesystem::is_directory(input)) GTEST_SKIP() << "no " << input << " (set POSIDONIA_DATA)";
	CTempFolder folder;
	TDatasetOptions options;
	options.input = input;
	options.output = folder / "euroc.rawlog";
	options.level = true;
	const TDatasetReport report = importDataset(options);
	EXPECT_EQ(report.observations.at("STEREO"), 30u);
	EXPECT_GT(report.observations.at("IMU"), 28000u);
	EXPECT_TRUE(report.rectified);
	EXPECT_NEAR(report.camera.baseline, 0.11007, 1e-4);
	EXPECT_LT((report.T_FRD_body.linear() * Vector3d(9.09, 0.13, -3.69)).head<2>().norm(), 0.2);

	CRawlogReader reader(options.output);
	const CStereoImageLoader loader(options.output);
	std::vector<double> dv;
	for (size_t n = 0; const auto o = reader.next();)
		if (const auto pair = std::dynamic_pointer_cast<mrpt::obs::CObservationStereoImages>(o);
			pair && n++ % 6 == 0) {
			EXPECT_NEAR(stereoSpecOf(*pair).camera.fx, report.camera.fx, 1e-9);
			for (double d : rowDifferences(loader.load(*pair)))
				dv.push_back(d);
		}
	ASSERT_GT(dv.size(), 500u);
	RecordProperty("median_dv_px", std::to_string(median(dv)));
	std::cout << "matches " << dv.size() << ", median |dv| " << median(dv) << " px\n";
	EXPECT_LT(median(dv), 0.5);
}
