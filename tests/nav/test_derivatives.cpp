#include <gtest/gtest.h>
#include <numerical_derivative.h>
#include <posidonia/nav/measurements.h>
#include <random_pose.h>

#include <memory>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace
{
TNavigationState randomState(std::mt19937& rng)
{
	TNavigationState x;
	x.position = randomVector(rng, 5);
	x.R_odom_body = randomPose(rng, 0, 1.7).linear();
	x.velocity = randomVector(rng, 1);
	x.gyro_bias = randomVector(rng, 0.1);
	x.clone_position = randomVector(rng, 5);
	x.R_odom_clone = randomPose(rng, 0, 1.7).linear();
	return x;
}

VectorNav movingError(const VectorXd& d)
{
	VectorNav e = VectorNav::Zero();
	e.head<kMovingSize>() = d;
	return e;
}
}  // namespace

TEST(NavDerivatives, RetractAndLocalCoordinatesAreInverse)
{
	std::mt19937 rng(1);
	for (int i = 0; i < 20; i++) {
		const TNavigationState x = randomState(rng), y = randomState(rng);
		EXPECT_LT(localCoordinates(retract(x, localCoordinates(x, y)), y).norm(), 1e-9) << "i=" << i;
	}
}

TEST(NavDerivatives, TransitionJacobianEqualsNumericalDerivative)
{
	std::mt19937 rng(2);
	for (double dt : {0.01, 0.2, 1.0}) {
		const TNavigationState x = randomState(rng);
		const TMotionInput u{randomVector(rng, 1), dt};
		const TNavigationState y = propagated(x, u);
		const MatrixXd numeric = numericalDerivative(
			[&](const VectorXd& d) -> VectorXd {
				return localCoordinates(y, propagated(retract(x, movingError(d)), u)).head<kMovingSize>();
			},
			kMovingSize);
		EXPECT_LT((numeric - transitionJacobian(x, u)).cwiseAbs().maxCoeff(), 1e-8) << "dt=" << dt;
	}
}

TEST(NavDerivatives, TheCloneStaysWhileTheBodyMoves)
{
	std::mt19937 rng(3);
	const TNavigationState x = randomState(rng), y = propagated(x, {Vector3d(0.1, 0.2, 0.3), 0.5});
	EXPECT_EQ(x.clone_position, y.clone_position);
	EXPECT_EQ(x.R_odom_clone, y.R_odom_clone);
	EXPECT_GT((x.position - y.position).norm(), 1e-3);
}

TEST(NavDerivatives, MeasurementJacobiansEqualNumericalDerivatives)
{
	std::mt19937 rng(4);
	for (int i = 0; i < 10; i++) {
		const Eigen::Isometry3d T_body_dvl = randomPose(rng, 1, 1.5);
		const Vector3d lever = randomVector(rng, 1);
		const TNavigationState x = randomState(rng);
		const Eigen::Matrix3d R = x.R_odom_body * expSO3(randomVector(rng, 0.3)),
							  I = Eigen::Matrix3d::Identity();
		std::vector<std::unique_ptr<CMeasurement>> all;
		all.push_back(
			std::make_unique<CDvlMeasurement>(Vector3d::Zero(), I, T_body_dvl, TBodyRate{lever, 1e-4}));
		all.push_back(std::make_unique<CDepthMeasurement>(3, 0.1, lever));
		all.push_back(std::make_unique<CHorizontalMeasurement>(Eigen::Vector2d(1, 2), 0.5, lever));
		all.push_back(std::make_unique<CAttitudeMeasurement>(R, 0.01, 0.02));
		all.push_back(std::make_unique<CGravityMeasurement>(R, 0.01));
		for (size_t kind = 0; kind < all.size(); kind++) {
			const MatrixXd numeric = numericalDerivative(
				[&](const VectorXd& d) -> VectorXd { return all[kind]->predicted(retract(x, VectorNav(d))); },
				kNavigationSize);
			EXPECT_LT((numeric - all[kind]->jacobian(x)).cwiseAbs().maxCoeff(), 1e-8)
				<< "kind=" << kind << " i=" << i;
		}
	}
}

TEST(NavDerivatives, DisplacementJacobianEqualsNumericalDerivative)
{
	std::mt19937 rng(5);
	for (int i = 0; i < 10; i++) {
		const TNavigationState x = randomState(rng);
		const Eigen::Isometry3d T = displacement(x);
		const MatrixXd numeric = numericalDerivative(
			[&](const VectorXd& d) -> VectorXd {
				return localCoordinates(T, displacement(retract(x, VectorNav(d))));
			},
			kNavigationSize);
		EXPECT_LT((numeric - displacementJacobian(x)).cwiseAbs().maxCoeff(), 1e-8) << "i=" << i;
	}
}

TEST(NavDerivatives, AttitudeNoiseIsThatOfErrorsAboutMapAxes)
{
	std::mt19937 rng(6);
	const Eigen::Matrix3d R = randomPose(rng, 0, 1).linear();
	const Vector3d e(1e-4, -2e-4, 3e-4);  // map axes
	const Vector3d in_body = logSO3(R.transpose() * expSO3(e) * R);
	EXPECT_LT((in_body - R.transpose() * e).norm(), 1e-12);
	const Eigen::Matrix3d back = R * attitudeNoise(R, 0.1, 0.5) * R.transpose();
	EXPECT_LT((back - Eigen::Matrix3d(Vector3d(0.01, 0.01, 0.25).asDiagonal())).norm(), 1e-12);
}
