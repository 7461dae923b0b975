#include <gtest/gtest.h>
#include <numerical_derivative.h>
#include <posidonia/nav/navigation_ekf.h>
#include <random_pose.h>

#include <memory>

#include <allocation_counter.h>

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

const TMotionNoise kNoise{0.03, 0.05, 3e-4, 4e-5, 4e-3, 6e-3, 1e-3, {0.01, 100}, {0.02, 100}, {1, 60}};

/** A vehicle that is pushed about a little. */
TMotionInput someMotion(std::mt19937& rng, double dt)
{
	return {EDrive::INERTIAL, randomVector(rng, 0.5), Vector3d(0, 0, -9.8) + randomVector(rng, 0.5), dt};
}

MatrixMoving randomMovingCovariance(std::mt19937& rng)
{
	std::normal_distribution<double> n;
	MatrixMoving A;
	for (int i = 0; i < A.size(); i++)
		A(i) = n(rng);
	const MatrixMoving cov = 0.01 * (A * A.transpose() / kMovingSize + 0.1 * MatrixMoving::Identity());
	return 0.5 * (cov + cov.transpose());
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
		ekf.predict(someMotion(rng, 0.1));
	return ekf;
}

CDvlMeasurement dvlWith(const TNavigationState& x, const Vector3d& error, const Matrix3d& cov)
{
	const CDvlMeasurement model = CDvlMeasurement::axes(Vector3d::Zero(), cov, {}, {});
	return CDvlMeasurement::axes(model.predicted(x).head<3>() + error, cov, {}, {});
}
}  // namespace

TEST(NavigationEKF, TransitionVirtualsAgreeWithEachOther)
{
	std::mt19937 rng(1);
	TProbe ekf = movedFilter(rng);
	const TMotionInput input = someMotion(rng, 0.1);
	ekf.predict(input);
	TProbe::KFMatrix_VxV F;
	ekf.OnTransitionJacobian(F);
	TProbe::KFArray_ACT u;
	for (int i = 0; i < 3; i++) {
		u[i] = input.rate[i];
		u[3 + i] = input.force[i];
	}
	u[6] = input.dt;
	u[7] = static_cast<double>(input.drive);
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
	const TMotionInput input = someMotion(rng, 0.2);
	MatrixNav F = MatrixNav::Identity(), Q = MatrixNav::Zero();
	F.topLeftCorner<kDriven, kDriving>() = drivenJacobian(x, input);
	F.diagonal().segment<5>(kAhrsBias) = gaussMarkovDecay(input.dt, kNoise);
	Q.topLeftCorner<kDriven, kDriven>() = drivenNoise(x, input, drivenJacobian(x, input), kNoise);
	Q.diagonal().segment<kMovingSize - kDriven>(kDriven) = walkingNoise(input.dt, kNoise);
	ekf.predict(input);
	EXPECT_LT((ekf.covariance() - (F * before * F.transpose() + Q)).cwiseAbs().maxCoeff(), 1e-12);
	EXPECT_LT(localCoordinates(propagated(x, input, kNoise), ekf.state()).norm(), 1e-12);
}

TEST(NavigationEKF, UpdateEqualsTheInformationForm)
{
	std::mt19937 rng(3);
	TProbe ekf = movedFilter(rng);
	// The clone began as an exact copy: give it a noise of its own, so that P can be inverted.
	for (int i = 0; i < 10; i++)
		ekf.predict(someMotion(rng, 0.3));
	const MatrixNav P = ekf.covariance();
	const TNavigationState x = ekf.state();
	const Matrix3d R = 0.02 * Matrix3d::Identity();
	const CDvlMeasurement z = dvlWith(x, Vector3d(0.05, -0.04, 0.03), R);
	const CMeasurement::Jacobian H = z.jacobian(x);
	const CMeasurement::Noise S = H * P * H.transpose() + z.noise();
	const Eigen::Matrix<double, kNavigationSize, 4> K = P * H.transpose() * S.inverse();
	const VectorNav error = K * Eigen::Vector4d(0.05, -0.04, 0.03, 0);
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
		ekf.predict(someMotion(rng, 0.02));
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
	ekf.predict(someMotion(rng, 1));
	EXPECT_GT(ekf.sinceClone().cov.diagonal().minCoeff(), 1e-9);
}

TEST(NavigationEKF, AnchorTakesTheReferenceButForTheHorizontalPosition)
{
	std::mt19937 rng(8);
	TProbe edge = movedFilter(rng), nav = movedFilter(rng);
	const MatrixNav other = nav.covariance();
	edge.anchor(nav);
	const MatrixNav P = edge.covariance();
	constexpr int kKept = kMovingSize - 2;
	EXPECT_EQ(edge.state().position, Vector3d(0, 0, nav.state().position.z()));
	EXPECT_EQ(edge.state().velocity, nav.state().velocity);
	EXPECT_EQ(edge.state().R_odom_body, nav.state().R_odom_body);
	EXPECT_EQ(edge.state().gyro_bias, nav.state().gyro_bias);
	EXPECT_EQ((P.block<2, kNavigationSize>(kPosition, 0).norm()), 0);
	EXPECT_EQ((P.block<kKept, kKept>(2, 2) - other.block<kKept, kKept>(2, 2)).norm(), 0);
	EXPECT_LT(edge.sinceClone().cov.norm(), 1e-14);
}

TEST(NavigationEKF, ARestoredFilterGoesOnAsTheSavedOne)
{
	std::mt19937 rng(11);
	TProbe ekf = movedFilter(rng), other = movedFilter(rng);
	TFilterState saved;
	ekf.save(saved);
	other.restore(saved);
	const TMotionInput input = someMotion(rng, 0.1);
	const CDvlMeasurement z = dvlWith(ekf.state(), {0.01, 0, 0}, 0.01 * Matrix3d::Identity());
	for (TProbe* filter : {&ekf, &other}) {
		filter->predict(input);
		filter->update(z);
	}
	EXPECT_EQ((ekf.covariance() - other.covariance()).norm(), 0);
	EXPECT_EQ(localCoordinates(ekf.state(), other.state()).norm(), 0);
}

TEST(NavigationEKF, NoAttitudeIsSingular)
{
	TProbe ekf(kNoise, 0.999);
	TNavigationState x;
	x.R_odom_body = rotationFromYawPitchRoll(0.4, M_PI / 2, 0);
	MatrixMoving cov = 0.01 * MatrixMoving::Identity();
	cov.block<3, 3>(kAhrsBias, kAhrsBias).setZero();
	ekf.initialize(x, cov);
	const Matrix3d R_measured = x.R_odom_body * expSO3({0.05, -0.03, 0.04});
	ASSERT_TRUE(ekf.update(CAttitudeMeasurement(R_measured, 1e-4, 1e-4)));
	EXPECT_LT(logSO3(R_measured.transpose() * ekf.state().R_odom_body).norm(), 1e-4);
}

TEST(NavigationEKF, IterationsDoNotAllocate)
{
	std::mt19937 rng(9);
	TProbe ekf = movedFilter(rng);
	const CDvlMeasurement z = dvlWith(ekf.state(), {0.01, 0, 0}, 0.01 * Matrix3d::Identity());
	ekf.predict(someMotion(rng, 0.01));
	ekf.update(z);	// the base's vectors get their size
	const size_t before = allocations();
	for (int i = 0; i < 100; i++) {
		ekf.predict(someMotion(rng, 0.001));
		ekf.update(z);
	}
	EXPECT_EQ(allocations() - before, 0u);
}
