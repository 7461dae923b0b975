#include "eval_testing.h"

#include <posidonia/eval/alignment.h>

#include <functional>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
double squaredError(const TAssociation& poses, const Isometry3d& T_truth_est)
{
	double sum = 0;
	for (const auto& p : poses)
		sum += (T_truth_est * p.T_est_body.translation() - p.T_truth_body.translation()).squaredNorm();
	return sum;
}

/** Least squared error over all positions for a given yaw: only the mean residual is left to fit. */
Isometry3d bestForYaw(const TAssociation& poses, double yaw)
{
	Isometry3d T(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
	Vector3d sum(0, 0, 0);
	for (const auto& p : poses)
		sum += p.T_truth_body.translation() - T * p.T_est_body.translation();
	T.translation() = sum / static_cast<double>(poses.size());
	return T;
}

double goldenSection(const std::function<double(double)>& f, double lo, double hi)
{
	const double g = (std::sqrt(5.0) - 1) / 2;
	while (hi - lo > 1e-9) {
		const double a = hi - g * (hi - lo), b = lo + g * (hi - lo);
		(f(a) < f(b) ? hi : lo) = f(a) < f(b) ? b : a;
	}
	return (lo + hi) / 2;
}
}  // namespace

TEST(Alignment, PlantedTransformsComeBack)
{
	std::mt19937 rng(5);
	for (int i = 0; i < 20; i++) {
		const Isometry3d T_truth_est = randomPose(rng, 20, 1.7);
		const TAssociation poses = noisyAssociation(rng, 80, T_truth_est.inverse(), 0, 0);
		for (EAlignment kind : {EAlignment::Origin, EAlignment::SE3})
			EXPECT_LT((align(kind, poses).matrix() - T_truth_est.matrix()).norm(), 1e-10)
				<< alignmentName(kind) << " i=" << i;
		EXPECT_TRUE(align(EAlignment::None, poses).matrix().isIdentity(0));
	}
}

TEST(Alignment, YawComesBackAndGravityIsKept)
{
	std::mt19937 rng(6);
	for (int i = 0; i < 20; i++) {
		Isometry3d T_truth_est(Eigen::AngleAxisd(-3 + 0.3 * i, Vector3d::UnitZ()));
		T_truth_est.translation() = randomVector(rng, 30);
		const TAssociation poses = noisyAssociation(rng, 80, T_truth_est.inverse(), 0, 0);
		EXPECT_LT((align(EAlignment::YawPosition, poses).matrix() - T_truth_est.matrix()).norm(), 1e-10)
			<< "i=" << i;
		const TAssociation tilted = noisyAssociation(rng, 80, randomPose(rng, 20, 1), 0.1, 0.1);
		const Vector3d down = align(EAlignment::YawPosition, tilted).linear() * Vector3d::UnitZ();
		EXPECT_EQ(down, Vector3d(0, 0, 1)) << "i=" << i;
	}
}

TEST(Alignment, SE3AgreesWithEigensUmeyama)
{
	std::mt19937 rng(7);
	for (int i = 0; i < 20; i++) {
		const TAssociation poses = noisyAssociation(rng, 60, randomPose(rng, 20, 1.7), 0.5, 0.1);
		Eigen::Matrix3Xd est(3, 60), truth(3, 60);
		for (int k = 0; k < 60; k++) {
			est.col(k) = poses[static_cast<size_t>(k)].T_est_body.translation();
			truth.col(k) = poses[static_cast<size_t>(k)].T_truth_body.translation();
		}
		const Eigen::Matrix4d expected = Eigen::umeyama(est, truth, false);
		EXPECT_LT((align(EAlignment::SE3, poses).matrix() - expected).norm(), 1e-9) << "i=" << i;
	}
}

TEST(Alignment, YawAgreesWithGoldenSection)
{
	std::mt19937 rng(8);
	for (int i = 0; i < 10; i++) {
		const TAssociation poses = noisyAssociation(rng, 60, randomPose(rng, 5, 0.3), 1.0, 0.1);
		const auto cost = [&](double yaw) { return squaredError(poses, bestForYaw(poses, yaw)); };
		const double yaw = goldenSection(cost, -1.5, 1.5);
		EXPECT_LT(
			(align(EAlignment::YawPosition, poses).matrix() - bestForYaw(poses, yaw).matrix()).norm(), 1e-5)
			<< "i=" << i;
	}
}

TEST(Alignment, NoNeighbourIsBetterAndMoreFreedomFitsBetter)
{
	std::mt19937 rng(9);
	for (int i = 0; i < 10; i++) {
		const TAssociation poses = noisyAssociation(rng, 60, randomPose(rng, 5, 0.5), 1.0, 0.1);
		const Isometry3d best = align(EAlignment::SE3, poses);
		for (int k = 0; k < 50; k++)
			EXPECT_LE(squaredError(poses, best), squaredError(poses, best * randomPose(rng, 0.02, 0.02)))
				<< "i=" << i;
		const double yaw = squaredError(poses, align(EAlignment::YawPosition, poses));
		EXPECT_LT(squaredError(poses, best), yaw) << "i=" << i;
		EXPECT_LT(yaw, squaredError(poses, Isometry3d::Identity())) << "i=" << i;
	}
}

TEST(Alignment, NeverMirrors)
{
	std::mt19937 rng(10);
	// A flat route: the third singular value is 0, and U V^T alone may be a reflection.
	TAssociation poses = noisyAssociation(rng, 40, Isometry3d::Identity(), 0, 0);
	for (auto& p : poses) {
		p.T_truth_body.translation().z() = 3.5;
		p.T_est_body.translation() = Vector3d(1, 1, -1).cwiseProduct(p.T_truth_body.translation());
	}
	const Isometry3d T = align(EAlignment::SE3, poses);
	EXPECT_NEAR(T.linear().determinant(), 1, 1e-12);
	EXPECT_LT(squaredError(poses, T), 1e-20);
}

TEST(Alignment, OnePoseIsEnoughNoneIsAnError)
{
	std::mt19937 rng(11);
	const TAssociation one = noisyAssociation(rng, 1, randomPose(rng, 5, 1), 0, 0);
	for (EAlignment kind : {EAlignment::Origin, EAlignment::YawPosition, EAlignment::SE3})
		EXPECT_LT(squaredError(one, align(kind, one)), 1e-20) << alignmentName(kind);
	expectContains(errorOf([] { align(EAlignment::SE3, {}); }), "no associated poses");
}
