#include <gtest/gtest.h>
#include <numerical_derivative.h>
#include <posidonia/nav/navigation_ekf.h>
#include <random_pose.h>

#include <memory>

#include "allocation_counter.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace
{
/** The virtuals that MRPT's base asks for, opened for the tests. */
struct TProbe : CNavigationEKF
{
	using CNavigationEKF::CNavigationEKF;
	using CNavigationEKF::OnTransitionJacobian;
	using CNavigationEKF::OnTransitionModel;
	using CNavigationEKF::OnTransitionNoise;
};

const TMotionNoise kNoise{0.03, 3e-4, 4e-5};

MatrixMoving randomMovingCovariance(std::mt19937& rng)
{
	std::normal_distribution<double> n;
	MatrixMoving A;
	for (int i = 0; i < A.size(); i++)
		A(i) = n(rng);
	return 0.01 * (A * A.transpose() / kMovingSize + 0.1 * MatrixMoving::Identity());
}

TNavigationState someState(std::mt19937& rng)
{
	TNavigationState x;
	x.position = randomVector(rng, 5);
	x.R_odom_body = randomPose(rng, 0, 1).linear();
	x.velocity = randomVector(rng, 1);
	x.gyro_bias = randomVector(rng, 0.1);
	return x;
}

/** A filter whose clone is somewhere else than its body. */
TProbe movedFilter(std::mt19937& rng)
{
	TProbe ekf(kNoise, 0.999);
	ekf.initialize(someState(rng), randomMovingCovariance(rng));
	for (int i = 0; i < 20; i++)
		ekf.predict({randomVector(rng, 0.5), 0.1});
	return ekf;
}

CDvlMeasurement dvlWith(const TNavigationState& x, const Vector3d& error, const Matrix3d& cov)
{
	const CDvlMeasurement model(Vector3d::Zero(), cov, Eigen::Isometry3d::Identity(), {});
	return CDvlMeasurement(model.predicted(x) + error, cov, Eigen::Isometry3d::Identity(), {});
}
}  // namespace

TEST(NavigationEKF, TransitionVirtualsAgreeWithEachOther)
{
	std::mt19937 rng(1);
	TProbe ekf = movedFilter(rng);
	const TMotionInput input{randomVector(rng, 0.5), 0.1};
	ekf.predict(input);
	TProbe::KFMatrix_VxV F;
	ekf.OnTransitionJacobian(F);
	TProbe::KFArray_ACT u;
	for (int i = 0; i < 3; i++)
		u[i] = input.rate[i];
	u[3] = input.dt;
	const MatrixXd numeric = numericalDerivative(
		[&](const VectorXd& d) -> VectorXd {
			TProbe::KFArray_VEH x;
			x.asEigen() = VectorNav(d);
			bool skip = true;
			ekf.OnTransitionModel(u, x, skip);
			EXPECT_FALSE(skip);
			return x.asEigen();
		},
		kNavigationSize);
	EXPECT_LT((numeric - MatrixXd(F.asEigen())).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(NavigationEKF, PredictionIsFPFtPlusQ)
{
	std::mt19937 rng(2);
	TProbe ekf = movedFilter(rng);
	const MatrixNav before = ekf.covariance();
	const TNavigationState x = ekf.state();
	const TMotionInput input{randomVector(rng, 0.5), 0.2};
	MatrixNav F = MatrixNav::Identity(), Q = MatrixNav::Zero();
	F.topLeftCorner<kMovingSize, kMovingSize>() = transitionJacobian(x, input);
	Q.topLeftCorner<kMovingSize, kMovingSize>() = transitionNoise(x, input, kNoise);
	ekf.predict(input);
	EXPECT_LT((ekf.covariance() - (F * before * F.transpose() + Q)).cwiseAbs().maxCoeff(), 1e-12);
	EXPECT_LT(localCoordinates(propagated(x, input), ekf.state()).norm(), 1e-12);
}

TEST(NavigationEKF, UpdateEqualsTheInformationForm)
{
	std::mt19937 rng(3);
	TProbe ekf = movedFilter(rng);
	// The clone began as an exact copy: give it a noise of its own, so that P can be inverted.
	for (int i = 0; i < 10; i++)
		ekf.predict({randomVector(rng, 0.5), 0.3});
	const MatrixNav P = ekf.covariance();
	const TNavigationState x = ekf.state();
	const Matrix3d R = 0.02 * Matrix3d::Identity();
	const CDvlMeasurement z = dvlWith(x, Vector3d(0.05, -0.04, 0.03), R);
	const CMeasurement::Jacobian H = z.jacobian(x);
	const Matrix3d S = H * P * H.transpose() + R;
	const Eigen::Matrix<double, kNavigationSize, 3> K = P * H.transpose() * S.inverse();
	const VectorNav error = K * Vector3d(0.05, -0.04, 0.03);
	ASSERT_TRUE(ekf.update(z));
	EXPECT_LT(localCoordinates(retract(x, error), ekf.state()).norm(), 1e-9);

	MatrixNav G = MatrixNav::Identity();
	G.block<3, 3>(kAttitude, kAttitude) = rightJacobianSO3(error.segment<3>(kAttitude));
	G.block<3, 3>(kCloneAttitude, kCloneAttitude) = rightJacobianSO3(error.segment<3>(kCloneAttitude));
	const MatrixNav posterior = G * (P - K * H * P) * G.transpose();
	EXPECT_LT((ekf.covariance() - posterior).cwiseAbs().maxCoeff(), 1e-12);
	EXPECT_LT(ekf.covariance()(kVelocity, kVelocity), P(kVelocity, kVelocity));
}

TEST(NavigationEKF, CovarianceStaysSymmetricAndPositive)
{
	std::mt19937 rng(4);
	TProbe ekf = movedFilter(rng);
	for (int i = 0; i < 5000; i++) {
		ekf.predict({randomVector(rng, 0.5), 0.02});
		if (i % 10 == 0)
			ekf.update(dvlWith(ekf.state(), randomVector(rng, 0.002), 2e-6 * Matrix3d::Identity()));
		if (i % 7 == 0) ekf.update(CAttitudeMeasurement(ekf.state().R_odom_body, 1e-4, 1e-4));
		if (i % 100 == 0) ekf.clone();
	}
	const MatrixNav P = ekf.covariance();
	EXPECT_EQ((P - P.transpose()).cwiseAbs().maxCoeff(), 0);
	const double smallest = Eigen::SelfAdjointEigenSolver<MatrixNav>(P).eigenvalues().minCoeff();
	EXPECT_GT(smallest, -1e-12 * P.trace());
}

TEST(NavigationEKF, GateIsTheChiSquareQuantileOfItsDegreesOfFreedom)
{
	// 99.9 % quantiles of chi-square with 1, 2, 3 degrees of freedom (tables): 10.83, 13.82, 16.27.
	std::mt19937 rng(5);
	const TProbe start = movedFilter(rng);
	const auto distanceOf = [&](const CMeasurement& m, bool& accepted) {
		TProbe ekf = start;
		accepted = ekf.update(m);
		return ekf.lastDistance();
	};
	const TNavigationState x = start.state();
	const double down = x.position.z();
	const Eigen::Vector2d north_east = x.position.head<2>();
	const double quantile[] = {10.83, 13.82, 16.27};
	for (int dof = 1; dof <= 3; dof++)
		for (double share : {0.97, 1.03}) {
			const auto make = [&](double e) -> std::unique_ptr<CMeasurement> {
				if (dof == 1) return std::make_unique<CDepthMeasurement>(down + e, 0.1, Vector3d::Zero());
				if (dof == 2)
					return std::make_unique<CHorizontalMeasurement>(
						north_east + Eigen::Vector2d(e, 0), 0.1, Vector3d::Zero());
				return std::make_unique<CDvlMeasurement>(dvlWith(x, {e, 0, 0}, 0.01 * Matrix3d::Identity()));
			};
			bool accepted = false;
			const double at_one_millimetre = distanceOf(*make(1e-3), accepted);	 // grows with the square
			const double e = 1e-3 * std::sqrt(share * quantile[dof - 1] / at_one_millimetre);
			distanceOf(*make(e), accepted);
			EXPECT_EQ(accepted, share < 1) << "dof=" << dof << " share=" << share;
		}
}

TEST(NavigationEKF, RefusedMeasurementChangesNothing)
{
	std::mt19937 rng(6);
	TProbe ekf = movedFilter(rng);
	const MatrixNav P = ekf.covariance();
	const TNavigationState x = ekf.state();
	EXPECT_FALSE(ekf.update(dvlWith(x, {100, 0, 0}, Matrix3d::Identity())));
	EXPECT_EQ((ekf.covariance() - P).norm(), 0);
	EXPECT_EQ(localCoordinates(x, ekf.state()).head<3>().norm(), 0);
	EXPECT_EQ(x.velocity, ekf.state().velocity);
}

TEST(NavigationEKF, RightAfterCloneTheDisplacementIsExactIdentity)
{
	std::mt19937 rng(7);
	TProbe ekf = movedFilter(rng);
	ekf.clone();
	EXPECT_LT((ekf.sinceClone().T.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
	EXPECT_LT(ekf.sinceClone().cov.norm(), 1e-14);
	EXPECT_GT(ekf.pose().cov.norm(), 1e-4);
	ekf.predict({Vector3d(0, 0, 0.1), 1});
	EXPECT_GT(ekf.sinceClone().cov.diagonal().minCoeff(), 1e-9);
}

TEST(NavigationEKF, AnchorTakesAttitudeAndBiasFromTheReferenceAndKeepsDepthAndVelocity)
{
	std::mt19937 rng(8);
	TProbe edge = movedFilter(rng), nav = movedFilter(rng);
	const MatrixNav own = edge.covariance(), other = nav.covariance();
	const TNavigationState x = edge.state();
	edge.anchor(nav);
	const MatrixNav P = edge.covariance();
	EXPECT_EQ(edge.state().position, Vector3d(0, 0, x.position.z()));
	EXPECT_EQ(edge.state().velocity, x.velocity);
	EXPECT_EQ(edge.state().R_odom_body, nav.state().R_odom_body);
	EXPECT_EQ(edge.state().gyro_bias, nav.state().gyro_bias);
	EXPECT_EQ((P.block<2, kNavigationSize>(kPosition, 0).norm()), 0);
	EXPECT_EQ((P.block<3, 3>(kVelocity, kVelocity) - own.block<3, 3>(kVelocity, kVelocity)).norm(), 0);
	EXPECT_EQ(P(2, 2), own(2, 2));
	EXPECT_EQ((P.block<3, 3>(kAttitude, kGyroBias) - other.block<3, 3>(kAttitude, kGyroBias)).norm(), 0);
	EXPECT_LT(edge.sinceClone().cov.norm(), 1e-14);
}

TEST(NavigationEKF, NoAttitudeIsSingular)
{
	TProbe ekf(kNoise, 0.999);
	TNavigationState x;
	x.R_odom_body = rotationFromYawPitchRoll(0.4, M_PI / 2, 0);
	ekf.initialize(x, 0.01 * MatrixMoving::Identity());
	const Matrix3d R_measured = x.R_odom_body * expSO3({0.05, -0.03, 0.04});
	ASSERT_TRUE(ekf.update(CAttitudeMeasurement(R_measured, 1e-4, 1e-4)));
	EXPECT_LT(logSO3(R_measured.transpose() * ekf.state().R_odom_body).norm(), 1e-4);
}

TEST(NavigationEKF, IterationsDoNotAllocate)
{
	std::mt19937 rng(9);
	TProbe ekf = movedFilter(rng);
	const CDvlMeasurement z = dvlWith(ekf.state(), {0.01, 0, 0}, 0.01 * Matrix3d::Identity());
	ekf.predict({Vector3d(0, 0, 0.1), 0.01});
	ekf.update(z);	// the base's vectors get their size
	const size_t before = allocations();
	for (int i = 0; i < 100; i++) {
		ekf.predict({Vector3d(0, 0, 0.1), 0.001});
		ekf.update(z);
	}
	EXPECT_EQ(allocations() - before, 0u);
}
