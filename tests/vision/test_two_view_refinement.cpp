#include "planted_pair.h"

#include <gtest/gtest.h>
#include <numerical_derivative.h>
#include <posidonia/vision/two_view_refinement.h>
#include <random_pose.h>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace
{
TPlantedPair somePair(unsigned seed, const TPlan& plan = {})
{
	std::mt19937 rng(seed);
	const Isometry3d T = randomPose(rng, 0.3, 0.15);
	return plantedPair(T, plan, rng);
}

/** Covariance of (u_left, v, u_right) from the independent noise of (u, v) and the disparity. */
Eigen::Matrix3d uvrCovariance(const TStereoPoint& p)
{
	const double s = double(p.sigma_uv) * p.sigma_uv, d = double(p.sigma_d) * p.sigma_d;
	Eigen::Matrix3d C;
	C << s, 0, s, 0, s, 0, s, 0, s + d;
	return C;
}

/** The bundle adjustment's dense normal matrix, pose first, from numerical derivatives of all six image
 * coordinates of every point; its pose block after elimination. */
Matrix6d denseInformation(const TPlantedPair& pair)
{
	const TStereoCamera camera;
	const int n = static_cast<int>(pair.truth.size());
	const auto predict = [&](const VectorXd& x) -> VectorXd {
		const Isometry3d T_b_a = retract(pair.T_a_b, x.head<6>()).inverse();
		VectorXd z(6 * n);
		for (int k = 0; k < n; k++) {
			const Vector3d p = pair.a.points[k].point + x.segment<3>(6 + 3 * k);
			z.segment<3>(6 * k) = camera.project(p);
			z.segment<3>(6 * k + 3) = camera.project(T_b_a * p);
		}
		return z;
	};
	const MatrixXd J = numericalDerivative(predict, 6 + 3 * n);
	MatrixXd W = MatrixXd::Zero(6 * n, 6 * n);
	for (int k = 0; k < n; k++) {
		W.block<3, 3>(6 * k, 6 * k) = uvrCovariance(pair.a.points[k]).inverse();
		W.block<3, 3>(6 * k + 3, 6 * k + 3) = uvrCovariance(pair.b.points[k]).inverse();
	}
	const MatrixXd covariance = (J.transpose() * W * J).inverse();
	return covariance.topLeftCorner<6, 6>().inverse();
}
}  // namespace

TEST(TukeyLoss, weightIsTheDerivativeOfTheCost)
{
	const TTukeyLoss loss{32};
	for (const double s : {0.1, 3.0, 15.0, 31.0, 40.0})
		EXPECT_NEAR((loss.cost(s + 1e-5) - loss.cost(s - 1e-5)) / 2e-5, loss.weight(s), 1e-8) << "s=" << s;
}

TEST(TukeyLoss, efficiencyGoesToOneWithTheCutoff)
{
	EXPECT_NEAR(TTukeyLoss{1e5}.efficiency(3), 1, 1e-3);
	EXPECT_GT(TTukeyLoss{32}.efficiency(3), 0.93);
	EXPECT_LT(TTukeyLoss{32}.efficiency(3), 0.98);
	EXPECT_LT(TTukeyLoss{8}.efficiency(3), TTukeyLoss{32}.efficiency(3));
}

TEST(TwoViewRefinement, gradientIsTheDerivativeOfTheProfileCost)
{
	for (unsigned seed = 1; seed <= 5; seed++) {
		const auto pair = somePair(seed, {40, 0.2});
		CTwoViewRefinement refinement(
			TStereoCamera(), pair.a, pair.b, CTwoViewRefinement::Matches(pair.truth));
		std::mt19937 rng(seed);
		const Isometry3d T = pair.T_a_b * randomPose(rng, 1e-3, 1e-3);
		const TTukeyLoss loss{200};
		const auto half_cost = [&](const VectorXd& d) -> VectorXd {
			return VectorXd::Constant(1, 0.5 * refinement.linearise(retract(T, d), loss).cost);
		};
		const Vector6d numeric = numericalDerivative(half_cost, 6, 1e-6).transpose();
		const Vector6d analytic = refinement.linearise(T, loss).g;
		EXPECT_LT((numeric - analytic).norm(), 1e-5 * analytic.norm()) << "seed=" << seed;
	}
}

TEST(TwoViewRefinement, informationIsTheDenseProblemsWithPointsEliminated)
{
	for (unsigned seed = 1; seed <= 4; seed++) {
		TPlan plan;
		plan.points = 20;
		plan.noise = 0;
		const auto pair = somePair(seed, plan);
		CTwoViewRefinement refinement(TStereoCamera(), pair.a, pair.b, pair.truth);
		refinement.chi2(pair.T_a_b);
		Matrix6d sum = Matrix6d::Zero();
		for (int k = 0; k < plan.points; k++)
			sum += refinement.information(pair.T_a_b, k);
		const Matrix6d dense = denseInformation(pair);
		EXPECT_LT((sum - dense).norm(), 1e-5 * dense.norm()) << "seed=" << seed;
	}
}

TEST(TwoViewRefinement, pointInformationIsTheInverseOfBothCovariances)
{
	// Schur complement = (C_b + R C_a R^T)^-1 pulled back by d(point)/d(pose): the covariances of the key
	// frames.
	TPlan plan;
	plan.noise = 0;
	const auto pair = somePair(3, plan);
	CTwoViewRefinement refinement(TStereoCamera(), pair.a, pair.b, pair.truth);
	refinement.chi2(pair.T_a_b);
	for (int k = 0; k < 10; k++) {
		const Eigen::Matrix3d R = pair.T_a_b.linear().transpose();
		const Eigen::Matrix3d C = pair.b.points[k].covariance.cast<double>() +
								  R * pair.a.points[k].covariance.cast<double>() * R.transpose();
		const Matrix6d I = refinement.information(pair.T_a_b, k);
		const Eigen::Matrix3d translation = I.topLeftCorner<3, 3>();
		EXPECT_LT((translation * C - Eigen::Matrix3d::Identity()).norm(), 1e-3) << "point " << k;
	}
}

TEST(TwoViewRefinement, exactMeasurementsGiveThePlantedPose)
{
	for (unsigned seed = 1; seed <= 10; seed++) {
		TPlan plan;
		plan.noise = 0;
		const auto pair = somePair(seed, plan);
		std::mt19937 rng(seed);
		CTwoViewRefinement refinement(TStereoCamera(), pair.a, pair.b, pair.truth);
		Isometry3d T;
		ASSERT_TRUE(refinement.solve(pair.T_a_b * randomPose(rng, 0.02, 0.01), TTukeyLoss(), T)) << seed;
		EXPECT_LT(localCoordinates(T, pair.T_a_b).norm(), 1e-9) << "seed=" << seed;
	}
}

TEST(TwoViewRefinement, optimumHasLessCostThanTruthAndStart)
{
	const auto pair = somePair(5);
	std::mt19937 rng(5);
	const Isometry3d start = pair.T_a_b * randomPose(rng, 0.01, 0.005);
	CTwoViewRefinement refinement(TStereoCamera(), pair.a, pair.b, pair.truth);
	const TTukeyLoss loss;
	Isometry3d T;
	ASSERT_TRUE(refinement.solve(start, loss, T));
	const double best = refinement.linearise(T, loss).cost;
	EXPECT_LT(best, refinement.linearise(start, loss).cost);
	EXPECT_LT(best, refinement.linearise(pair.T_a_b, loss).cost);
	EXPECT_LT(refinement.linearise(T, loss).g.norm(), 1e-3);
}
