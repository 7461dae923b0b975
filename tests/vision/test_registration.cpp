#include "planted_pair.h"

#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/vision/descriptor_matching.h>
#include <posidonia/vision/stereo_registration.h>
#include <random_pose.h>

#include <future>
#include <opencv2/core.hpp>
#include <set>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;

namespace
{
constexpr double DEG = M_PI / 180;

CStereoRegistration registration(const TRegistrationOptions& options = {})
{
	return {options, TStereoCamera()};
}

/** b's camera against a's, both over the floor 2.5 m below a, turned round the optical axis. */
Isometry3d turned(double yaw_deg, double altitude_ratio, double tilt_deg)
{
	Isometry3d T = Isometry3d::Identity();
	T.linear() = rotationFromYawPitchRoll(yaw_deg * DEG, tilt_deg * DEG, -0.7 * tilt_deg * DEG);
	T.translation() << 0.2, -0.1, 2.5 * (1 - altitude_ratio);
	return T;
}

bool identical(const TRegistration& p, const TRegistration& q)
{
	return p.status == q.status && p.T_a_b.matrix() == q.T_a_b.matrix() && p.information == q.information &&
		   p.inlier_pairs == q.inlier_pairs && p.chi2 == q.chi2;
}
}  // namespace

TEST(Matching, distancesEqualTheDefinition)
{
	std::mt19937 rng(1);
	const cv::Mat a = randomDescriptors(37, rng), b = randomDescriptors(41, rng);
	const CDescriptorDistance euclid(a, b, false),
		hamming(a.colRange(0, 61).clone(), b.colRange(0, 61).clone(), true);
	for (int i = 0; i < a.rows; i++)
		for (int j = 0; j < b.rows; j++) {
			EXPECT_EQ(euclid(i, j), std::lround(cv::norm(a.row(i), b.row(j), cv::NORM_L2SQR)))
				<< i << " " << j;
			EXPECT_EQ(
				hamming(i, j),
				std::lround(cv::norm(a.row(i).colRange(0, 61), b.row(j).colRange(0, 61), cv::NORM_HAMMING)));
		}
}

TEST(Matching, reciprocalPairsAreSymmetric)
{
	std::mt19937 rng(2);
	const cv::Mat a = randomDescriptors(90, rng), b = randomDescriptors(80, rng);
	for (const bool binary : {false, true})
		for (const double ratio : {1.0, 0.98}) {
			std::set<std::pair<int, int>> ab, ba;
			for (const auto& m : matchReciprocal(a, b, binary, ratio))
				ab.emplace(m.a, m.b);
			for (const auto& m : matchReciprocal(b, a, binary, ratio))
				ba.emplace(m.b, m.a);
			EXPECT_EQ(ab, ba) << "binary=" << binary << " ratio=" << ratio;
			EXPECT_FALSE(ab.empty());
		}
}

TEST(Registration, plantedPoseComesBack)
{
	std::mt19937 rng(3);
	for (const double yaw : {0.0, 45.0, 90.0, 180.0})
		for (const double altitude : {0.8, 1.0, 1.25})
			for (const double tilt : {0.0, 8.0})
				for (const double outliers : {0.0, 0.3, 0.6, 0.8}) {
					const auto pair = plantedPair(turned(yaw, altitude, tilt), {250, outliers}, rng);
					const auto r = registration().align(pair.a, pair.b, 5);
					const auto name = "yaw=" + std::to_string(yaw) + " altitude=" + std::to_string(altitude) +
									  " tilt=" + std::to_string(tilt) +
									  " outliers=" + std::to_string(outliers);
					ASSERT_TRUE(r.accepted()) << name << ": " << toString(r.status);
					const Vector6d e = localCoordinates(r.T_a_b, pair.T_a_b);
					EXPECT_LT(e.head<3>().norm(), 0.01) << name;
					EXPECT_LT(e.tail<3>().norm(), 0.004) << name;
					EXPECT_GE(r.inliers, 0.97 * static_cast<double>(pair.truth.size())) << name;
				}
}

TEST(Registration, flatFloorIsNoTrap)
{
	std::mt19937 rng(4);
	TPlan plan;
	plan.relief = 0;
	plan.points = 60;
	plan.outlier_share = 0.5;
	for (int i = 0; i < 60; i++) {
		const auto pair = plantedPair(turned(6.0 * i, 0.9 + 0.004 * i, 4), plan, rng);
		const auto r = registration().align(pair.a, pair.b, i);
		ASSERT_TRUE(r.accepted()) << "trial " << i << ": " << toString(r.status);
		EXPECT_LT(localCoordinates(r.T_a_b, pair.T_a_b).norm(), 0.03) << "trial " << i;
	}
}

TEST(Registration, bothDirectionsAgree)
{
	std::mt19937 rng(5);
	TRegistrationOptions as_asked;
	as_asked.canonical_order = false;
	for (int i = 0; i < 40; i++) {
		const auto pair = plantedPair(turned(9.0 * i, 1, 5), {120, 0.4}, rng);
		for (const bool canonical : {true, false}) {
			as_asked.canonical_order = canonical;
			const auto ab = registration(as_asked).align(pair.a, pair.b, i);
			const auto ba = registration(as_asked).align(pair.b, pair.a, i);
			ASSERT_TRUE(ab.accepted() && ba.accepted()) << "trial " << i;
			EXPECT_EQ(ab.inliers, ba.inliers);
			EXPECT_LT(localCoordinates(ab.T_a_b, ba.T_a_b.inverse()).norm(), canonical ? 1e-12 : 1e-8)
				<< "trial " << i << " canonical=" << canonical;
			const Matrix6d covariance = inverseCovariance(ab.T_a_b, ab.information.inverse());
			EXPECT_LT((covariance * ba.information - Matrix6d::Identity()).norm(), 1e-5) << "trial " << i;
		}
	}
}

TEST(Registration, squaredMahalanobisErrorIsSix)
{
	std::mt19937 rng(6);
	constexpr int TRIALS = 300;
	double sum = 0, points = 0, outside = 0;
	for (int i = 0; i < TRIALS; i++) {
		const auto pair = plantedPair(turned(i * 1.2, 0.9 + 0.001 * i, 4), {100, 0.2}, rng);
		const auto r = registration().align(pair.a, pair.b, i);
		ASSERT_TRUE(r.accepted()) << "trial " << i;
		const Vector6d e = localCoordinates(r.T_a_b, pair.T_a_b);
		const double chi2 = e.dot(r.information * e);
		sum += chi2;
		outside += chi2 > 16.81;  // 99 % of chi2 with 6 degrees of freedom
		points += r.chi2 / r.dof();
	}
	EXPECT_GT(sum / (6 * TRIALS), 0.85);
	EXPECT_LT(sum / (6 * TRIALS), 1.15);
	EXPECT_LT(outside / TRIALS, 0.03);
	EXPECT_NEAR(points / TRIALS, 1, 0.05);
}

TEST(Registration, repeatsAndThreadsGiveTheSameBits)
{
	std::mt19937 rng(7);
	const auto pair = plantedPair(turned(33, 1.1, 5), {200, 0.6}, rng);
	const auto one = registration();
	const auto first = one.align(pair.a, pair.b, 9);
	ASSERT_TRUE(first.accepted());
	EXPECT_TRUE(identical(first, one.align(pair.a, pair.b, 9)));
	std::vector<std::future<TRegistration>> jobs;
	for (int i = 0; i < 4; i++)
		jobs.push_back(std::async(std::launch::async, [&] { return one.align(pair.a, pair.b, 9); }));
	for (auto& job : jobs)
		EXPECT_TRUE(identical(first, job.get()));
	cv::setNumThreads(1);
	const auto single = one.align(pair.a, pair.b, 9);
	cv::setNumThreads(-1);
	EXPECT_TRUE(identical(first, single));
}

TEST(Registration, eachFailureHasItsName)
{
	using S = ERegistrationStatus;
	std::mt19937 rng(8);
	const Isometry3d T = turned(10, 1, 2);
	const auto good = plantedPair(T, {100}, rng);
	const auto status = [](const TPlantedPair& p, const TRegistrationOptions& o = {}) {
		return registration(o).align(p.a, p.b).status;
	};
	EXPECT_EQ(status(good), S::ACCEPTED);
	EXPECT_EQ(status(TPlantedPair{}), S::TOO_FEW_POINTS);
	EXPECT_EQ(status(plantedPair(T, {10}, rng)), S::TOO_FEW_POINTS);

	auto strangers = good;
	strangers.b.descriptors = randomDescriptors(static_cast<int>(good.b.size()), rng);
	EXPECT_EQ(status(strangers), S::TOO_FEW_MATCHES);
	TRegistrationOptions no_ratio;
	no_ratio.match_ratio = 1;
	EXPECT_NE(status(strangers, no_ratio), S::ACCEPTED);

	const S scattered = status(plantedPair(T, {100, 0.97}, rng));
	EXPECT_TRUE(
		scattered == S::RANSAC_FAILED || scattered == S::TOO_FEW_INLIERS || scattered == S::REFINEMENT_FAILED)
		<< toString(scattered);
	TRegistrationOptions many;
	many.min_inliers = 101;
	EXPECT_EQ(status(good, many), S::TOO_FEW_INLIERS);
	TRegistrationOptions strict;
	strict.max_rmse = 1e-3;
	EXPECT_EQ(status(good, strict), S::RMSE_TOO_LARGE);

	TPlan line{100}, spot{100};
	line.half_height = 2;
	line.relief = 0;
	spot.half_width = spot.half_height = 8;
	const Isometry3d ahead = turned(0, 1, 0);
	for (const TPlan& plan : {line, spot})
		EXPECT_NE(status(plantedPair(ahead, plan, rng)), S::ACCEPTED) << plan.half_width;
	EXPECT_EQ(status(plantedPair(ahead, line, rng)), S::CLUSTERED);
}

TEST(Registration, statusesHaveDistinctTexts)
{
	std::set<std::string> texts;
	for (const auto s : allRegistrationStatuses())
		texts.insert(toString(s));
	EXPECT_EQ(texts.size(), allRegistrationStatuses().size());
}

TEST(Registration, mixedDescriptorsAreRefused)
{
	std::mt19937 rng(9);
	auto pair = plantedPair(turned(0, 1, 0), {50}, rng);
	pair.b.binary = true;
	EXPECT_THROW(registration().align(pair.a, pair.b), CError);
}

TEST(Registration, onePlaceVotesOnce)
{
	std::mt19937 rng(10);
	auto pair = plantedPair(turned(0, 1, 0), {50}, rng);
	// A second descriptor (another orientation) of every place.
	const auto twice = [](TKeyFrame& f, const cv::Mat& more) {
		f.points.insert(f.points.end(), f.points.begin(), f.points.begin() + 50);
		cv::vconcat(f.descriptors.clone(), more, f.descriptors);
	};
	const cv::Mat more = randomDescriptors(50, rng);
	const auto single = registration().align(pair.a, pair.b);
	twice(pair.a, more);
	twice(pair.b, more);
	const auto doubled = registration().align(pair.a, pair.b);
	EXPECT_EQ(doubled.matches, 50);
	EXPECT_LT((doubled.information - single.information).norm(), 1e-6 * single.information.norm());
}
