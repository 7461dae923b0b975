#include <gtest/gtest.h>
#include <numerical_derivative.h>
#include <posidonia/geometry/se3.h>
#include <random_pose.h>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

TEST(SE3, LogIsInverseOfExpAtEveryAngle)
{
	std::mt19937 rng(1);
	for (double angle : {0.0, 1e-12, 1e-7, 1e-3, 0.5, 1.5, 3.0, M_PI - 1e-6, M_PI - 1e-9}) {
		const Vector3d phi = randomVector(rng, 1).normalized() * angle;
		EXPECT_LT((logSO3(expSO3(phi)) - phi).norm(), 1e-7) << "angle=" << angle;
	}
}

TEST(SE3, RetractAndLocalCoordinatesAreInverse)
{
	std::mt19937 rng(2);
	for (int i = 0; i < 50; i++) {
		const Isometry3d T = randomPose(rng, 5, 1.5), U = randomPose(rng, 5, 1.5);
		EXPECT_LT((retract(T, localCoordinates(T, U)).matrix() - U.matrix()).norm(), 1e-12) << "i=" << i;
	}
}

TEST(SE3, RightJacobianEqualsNumericalDerivative)
{
	std::mt19937 rng(3);
	for (double scale : {1e-4, 0.02, 0.5, 1.7}) {
		const Vector3d phi = randomVector(rng, scale);
		const auto f = [&](const VectorXd& d) -> VectorXd {
			return logSO3(expSO3(phi).transpose() * expSO3(phi + Vector3d(d)));
		};
		EXPECT_LT((numericalDerivative(f, 3) - rightJacobianSO3(phi)).norm(), 1e-8) << "scale=" << scale;
		EXPECT_LT(
			(rightJacobianSO3(phi) * rightJacobianInverseSO3(phi) - Eigen::Matrix3d::Identity()).norm(), 1e-9)
			<< "scale=" << scale;
	}
}

TEST(SE3, ComposeAndInverseCovarianceUseTheTrueDerivatives)
{
	std::mt19937 rng(4);
	for (int i = 0; i < 10; i++) {
		const Isometry3d A = randomPose(rng, 3, 1), B = randomPose(rng, 3, 1);
		const Matrix6d cov_A = randomCovariance(rng, 0.1), cov_B = randomCovariance(rng, 0.1);
		const MatrixXd JA = numericalDerivative(
			[&](const VectorXd& d) -> VectorXd { return localCoordinates(A * B, retract(A, d) * B); }, 6);
		const MatrixXd JB = numericalDerivative(
			[&](const VectorXd& d) -> VectorXd { return localCoordinates(A * B, A * retract(B, d)); }, 6);
		const MatrixXd JI = numericalDerivative(
			[&](const VectorXd& d) -> VectorXd {
				return localCoordinates(A.inverse(), retract(A, d).inverse());
			},
			6);
		const MatrixXd expected = JA * cov_A * JA.transpose() + JB * cov_B * JB.transpose();
		EXPECT_LT((composeCovariance(cov_A, B, cov_B) - expected).norm(), 1e-7) << "i=" << i;
		EXPECT_LT((inverseCovariance(A, cov_A) - JI * cov_A * JI.transpose()).norm(), 1e-7) << "i=" << i;
	}
}

TEST(SE3, YawPitchRollRoundTrip)
{
	for (double yaw : {-3.0, 0.0, 2.0})
		for (double pitch : {-1.4, 0.0, 1.4})
			for (double roll : {-2.5, 0.0, 0.3}) {
				const Vector3d ypr = yawPitchRoll(rotationFromYawPitchRoll(yaw, pitch, roll));
				EXPECT_LT((ypr - Vector3d(yaw, pitch, roll)).norm(), 1e-12)
					<< yaw << " " << pitch << " " << roll;
			}
}
