#include <gtest/gtest.h>
#include <numerical_derivative.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <random_pose.h>

using namespace posidonia;
using namespace posidonia::testing;

TEST(MrptPose, RoundTripKeepsTheMatrix)
{
	std::mt19937 rng(1);
	for (int i = 0; i < 20; i++) {
		const Eigen::Isometry3d T = randomPose(rng, 10, 1.2);
		EXPECT_LT((fromMrpt(toMrpt(T)).matrix() - T.matrix()).norm(), 1e-12) << "i=" << i;
	}
}

TEST(MrptPose, JacobianEqualsNumericalDerivative)
{
	std::mt19937 rng(2);
	for (int i = 0; i < 20; i++) {
		const Eigen::Isometry3d T = randomPose(rng, 3, 0.8);
		const auto f = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
			const mrpt::poses::CPose3D p = toMrpt(retract(T, d));
			Vector6d x;
			x << p.x(), p.y(), p.z(), p.yaw(), p.pitch(), p.roll();
			return x;
		};
		EXPECT_LT((numericalDerivative(f, 6) - mrptFromLocalJacobian(T)).norm(), 1e-7) << "i=" << i;
	}
}

TEST(MrptPose, GaussiansRoundTrip)
{
	std::mt19937 rng(3);
	const Eigen::Isometry3d T = randomPose(rng, 3, 0.8);
	const Matrix6d cov = randomCovariance(rng, 0.1);
	EXPECT_LT((localCovariance(toMrptGaussian(T, cov)) - cov).norm(), 1e-12);
	const Matrix6d information = cov.inverse();
	EXPECT_LT(
		(localInformation(toMrptGaussianInf(T, information)) - information).norm(),
		1e-8 * information.norm());
}
