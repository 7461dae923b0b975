#include <gtest/gtest.h>
#include <numerical_derivative.h>
#include <posidonia/nav/measurements.h>
#include <posidonia/nav/motion_model.h>
#include <posidonia/obs/sensor_suite.h>
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
	x.accel_bias = randomVector(rng, 0.2);
	x.dvl_scale = randomVector(rng, 0.02).x();
	x.pressure_offset = randomVector(rng, 0.2).x();
	x.ahrs_bias = randomVector(rng, 0.3);
	x.gps_bias = randomVector(rng, 1).head<2>();
	x.clone_position = randomVector(rng, 5);
	x.R_odom_clone = randomPose(rng, 0, 1.7).linear();
	return x;
}

const TMotionNoise kNoise{0.03, 0.05, 3e-4, 4e-5, 4e-3, 6e-3, 1e-3, {0.01, 100}, {0.02, 100}, {1, 60}};

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
	for (EDrive drive : {EDrive::INERTIAL, EDrive::GYRO, EDrive::KINEMATIC})
		for (double dt : {0.01, 0.2, 1.0}) {
			const TNavigationState x = randomState(rng);
			const TMotionInput u{drive, randomVector(rng, 1), randomVector(rng, 10), dt};
			const TNavigationState y = propagated(x, u, kNoise);
			const MatrixXd numeric = numericalDerivative(
				[&](const VectorXd& d) -> VectorXd {
					return localCoordinates(y, propagated(retract(x, movingError(d)), u, kNoise))
						.head<kMovingSize>();
				},
				kMovingSize);
			MatrixMoving F = MatrixMoving::Identity();
			F.topLeftCorner<kDriven, kDriving>() = drivenJacobian(x, u);
			F.diagonal().segment<5>(kAhrsBias) = gaussMarkovDecay(dt, kNoise);
			EXPECT_LT((numeric - F).cwiseAbs().maxCoeff(), 1e-7)
				<< "drive=" << static_cast<int>(drive) << " dt=" << dt;
		}
}

TEST(NavDerivatives, TwoHalfStepsAreOneStep)
{
	// A constant rate and force: the state after dt does not depend on how it is cut, to second order of the
	// turn.
	std::mt19937 rng(7);
	TNavigationState x = randomState(rng);
	for (EDrive drive : {EDrive::INERTIAL, EDrive::GYRO, EDrive::KINEMATIC}) {
		TMotionInput u{drive, randomVector(rng, 0.2), randomVector(rng, 10), 0.02};
		const TNavigationState whole = propagated(x, u, kNoise);
		u.dt = 0.01;
		const TNavigationState halves = propagated(propagated(x, u, kNoise), u, kNoise);
		EXPECT_LT(localCoordinates(whole, halves).norm(), 1e-5) << "drive=" << static_cast<int>(drive);
	}
}

TEST(NavDerivatives, StepNoiseOfHalfStepsAddsUp)
{
	// Q(dt) = F(dt/2) Q(dt/2) F(dt/2)^T + Q(dt/2): the densities are those of a continuous process.
	std::mt19937 rng(8);
	const TNavigationState x = randomState(rng);
	for (EDrive drive : {EDrive::GYRO, EDrive::KINEMATIC}) {
		TMotionInput u{drive, x.gyro_bias, Vector3d::Zero(), 0.02};
		const auto whole = drivenNoise(x, u, drivenJacobian(x, u), kNoise);
		u.dt = 0.01;
		const TNavigationState middle = propagated(x, u, kNoise);
		const Eigen::Matrix<double, 9, 9> F = drivenJacobian(middle, u).leftCols<9>(),
										  first = drivenNoise(x, u, drivenJacobian(x, u), kNoise),
										  second = drivenNoise(middle, u, drivenJacobian(middle, u), kNoise);
		const Eigen::Matrix<double, 9, 9> halves = F * first * F.transpose() + second;
		const auto size = whole.diagonal().cwiseSqrt();
		// A reading's noise is constant over its step, so its position part is dt^3/4 and not dt^3/3: allow
		// it.
		EXPECT_LT(
			((whole - halves).array() / (size * size.transpose()).array().max(1e-30)).abs().maxCoeff(), 0.3)
			<< "drive=" << static_cast<int>(drive);
	}
}

TEST(NavDerivatives, TheCloneStaysWhileTheBodyMoves)
{
	std::mt19937 rng(3);
	const TNavigationState x = randomState(rng),
						   y = propagated(
							   x, {EDrive::INERTIAL, Vector3d(0.1, 0.2, 0.3), Vector3d(0, 0, -9.8), 0.5},
							   kNoise);
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
		const TDvlMount mount{T_body_dvl.linear().transpose(), T_body_dvl.translation()};
		const TBodyRate rate{randomVector(rng, 1), 1e-4};
		const Eigen::Vector4d beams(0.1, std::nan(""), 0.2, 0.3);
		all.push_back(
			std::make_unique<CDvlMeasurement>(CDvlMeasurement::axes(Vector3d::Zero(), I, mount, rate)));
		all.push_back(std::make_unique<CDvlMeasurement>(
			CDvlMeasurement::beams(beams, 0.01, TDvlSpec().beams(), mount, rate)));
		all.push_back(
			std::make_unique<CBodyVelocityMeasurement>(Vector3d::Zero(), Vector3d::Ones(), lever, rate));
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
