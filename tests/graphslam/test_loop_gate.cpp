// Is a registration believed? The gate by hand, by law and by statistics.
#include <gtest/gtest.h>
#include <posidonia/graphslam/loop_gate.h>

#include <random_pose.h>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
TGateOptions withoutFloors()
{
	TGateOptions options;
	options.sigma_floor_xyz = options.sigma_floor_angle = 0;
	return options;
}

TRelativePrediction randomPrediction(std::mt19937& rng, double sigma)
{
	return {randomPose(rng, 5, 2), randomCovariance(rng, sigma)};
}

/** Share of a chi-square of 6 degrees of freedom below x, in closed form. */
double chiSquare6Below(double x)
{
	return 1 - std::exp(-x / 2) * (1 + x / 2 + x * x / 8);
}

Vector6d randomNormal(std::mt19937& rng, const Matrix6d& covariance)
{
	std::normal_distribution<double> n;
	Vector6d white;
	for (int k = 0; k < 6; k++)
		white[k] = n(rng);
	return covariance.llt().matrixL() * white;
}
}  // namespace

TEST(LoopGate, thresholdIsTheChiSquareQuantile)
{
	for (double confidence : {0.5, 0.9, 0.99, 0.999, 0.999999}) {
		TGateOptions options;
		options.confidence = confidence;
		EXPECT_NEAR(chiSquare6Below(CLoopGate(options).threshold()), confidence, 1e-9)
			<< "confidence " << confidence;
	}
}

TEST(LoopGate, mahalanobisByHandOnAxes)
{
	TGateOptions options;
	options.sigma_floor_xyz = 0.3;
	options.sigma_floor_angle = 0.03;
	const CLoopGate gate(options);
	std::mt19937 rng(1);
	for (int k = 0; k < 6; k++) {
		TRelativePrediction prediction;
		prediction.T_i_j = randomPose(rng, 5, 2);
		const double unit = k < 3 ? 1 : 0.1;
		prediction.covariance = 0.16 * unit * unit * Matrix6d::Identity();			 // sigma 0.4
		const Matrix6d information = Matrix6d::Identity() / (0.0144 * unit * unit);	 // sigma 0.12
		Vector6d d = Vector6d::Zero();
		d[k] = 2 * unit;
		// 0.4^2 + 0.12^2 + 0.3^2 = 0.2644
		EXPECT_NEAR(
			gate.mahalanobis2(prediction, retract(prediction.T_i_j, d), information), 4 / 0.2644, 1e-9)
			<< "axis " << k;
	}
}

TEST(LoopGate, mahalanobisAddsTheCovariances)
{
	std::mt19937 rng(2);
	const CLoopGate gate(withoutFloors());
	for (int n = 0; n < 50; n++) {
		const TRelativePrediction prediction = randomPrediction(rng, 0.1);
		const Matrix6d measured = randomCovariance(rng, 0.05);
		const Vector6d d = 0.2 * (Vector6d() << randomVector(rng, 1), randomVector(rng, 1)).finished();
		const Matrix6d S = prediction.covariance + measured;
		const double expected = d.dot(S.inverse() * d);
		EXPECT_NEAR(
			gate.mahalanobis2(prediction, retract(prediction.T_i_j, d), measured.inverse()), expected,
			1e-6 * expected)
			<< "case " << n;
	}
}

TEST(LoopGate, floorsOnlyLetMorePass)
{
	std::mt19937 rng(3);
	const CLoopGate bare(withoutFloors()), floored{TGateOptions{}};
	for (int n = 0; n < 50; n++) {
		const TRelativePrediction prediction = randomPrediction(rng, 0.02);
		const auto T = retract(prediction.T_i_j, randomNormal(rng, prediction.covariance));
		const Matrix6d information = randomCovariance(rng, 0.01).inverse();
		EXPECT_LT(
			floored.mahalanobis2(prediction, T, information), bare.mahalanobis2(prediction, T, information))
			<< "case " << n;
	}
}

TEST(LoopGate, passesTheShareOfTrueLoopsThatItSays)
{
	TGateOptions options = withoutFloors();
	options.confidence = 0.9;
	const CLoopGate gate(options);
	std::mt19937 rng(4);
	int passed = 0;
	constexpr int kCases = 5000;
	for (int n = 0; n < kCases; n++) {
		const TRelativePrediction prediction = randomPrediction(rng, 0.05);
		const Matrix6d measured = randomCovariance(rng, 0.03);
		const Vector6d d = randomNormal(rng, prediction.covariance + measured);
		passed += !gate.refuse(prediction, retract(prediction.T_i_j, d), measured.inverse());
	}
	EXPECT_NEAR(double(passed) / kCases, 0.9, 4 * std::sqrt(0.9 * 0.1 / kCases));
}

TEST(LoopGate, refusalNamesTheGate)
{
	TRelativePrediction prediction;
	prediction.covariance = 1e-4 * Matrix6d::Identity();
	auto far = prediction.T_i_j;
	far.translation() << 3, 4, 0;
	const Matrix6d information = 1e4 * Matrix6d::Identity();
	EXPECT_EQ(
		CLoopGate{TGateOptions{}}.refuse(prediction, far, information), "refused by the chi-square gate");
	EXPECT_EQ(CLoopGate{TGateOptions{}}.refuse(prediction, prediction.T_i_j, information), std::nullopt);
}

TEST(LoopGate, jumpGateMeasuresMetresOnly)
{
	TGateOptions options;
	options.kind = "jump";
	options.max_jump = 5.01;
	std::mt19937 rng(5);
	for (int n = 0; n < 20; n++) {
		TRelativePrediction prediction;	 // no covariance at all
		prediction.T_i_j = randomPose(rng, 5, 2);
		auto T = randomPose(rng, 5, 2);	 // any attitude
		T.translation() = prediction.T_i_j.translation() + expSO3(randomVector(rng, 3)) * Vector3d(3, 4, 0);
		options.max_jump = 5.01;
		EXPECT_FALSE(CLoopGate(options).refuse(prediction, T, Matrix6d::Identity())) << "case " << n;
		options.max_jump = 4.99;
		EXPECT_EQ(CLoopGate(options).refuse(prediction, T, Matrix6d::Identity()), "refused by the jump gate");
	}
	EXPECT_FALSE(CLoopGate(options).needsCovariance());
	EXPECT_TRUE(CLoopGate{TGateOptions{}}.needsCovariance());
}

TEST(LargerOfGraphAndDrift, keepsWhatIsLargerAxisByAxisOfTheMap)
{
	std::mt19937 rng(6);
	for (int n = 0; n < 100; n++) {
		const Matrix3d R = expSO3(randomVector(rng, 3));
		const Matrix6d C = randomCovariance(rng, 0.3);
		const Vector3d drift = (0.3 * randomVector(rng, 1)).cwiseAbs2();
		const Matrix6d out = largerOfGraphAndDrift(C, R, drift);
		EXPECT_LT((out - out.transpose()).norm(), 1e-12) << "case " << n;
		EXPECT_TRUE(isPositiveDefinite(0.5 * (out + out.transpose()))) << "case " << n;

		const Matrix3d before = R * C.topLeftCorner<3, 3>() * R.transpose();
		const Matrix3d after = R * out.topLeftCorner<3, 3>() * R.transpose();
		const Eigen::Matrix3d cross_after = R * out.topRightCorner<3, 3>(),
							  cross_before = R * C.topRightCorner<3, 3>();
		for (int axis = 0; axis < 3; axis++) {
			const bool larger = drift[axis] > before(axis, axis);
			EXPECT_NEAR(after(axis, axis), std::max(before(axis, axis), drift[axis]), 1e-12) << "case " << n;
			const Vector3d expected_cross = larger ? Vector3d::Zero() : Vector3d(cross_before.row(axis));
			EXPECT_LT((Vector3d(cross_after.row(axis)) - expected_cross).norm(), 1e-12) << "case " << n;
			for (int other = 0; other < 3; other++) {
				if (other == axis) continue;
				const bool kept = !larger && drift[other] <= before(other, other);
				EXPECT_NEAR(after(axis, other), kept ? before(axis, other) : 0, 1e-12) << "case " << n;
			}
		}
		const Matrix3d rotations = (out - C).bottomRightCorner<3, 3>();
		EXPECT_LT(rotations.norm(), 1e-12) << "case " << n;
	}
}

TEST(LargerOfGraphAndDrift, isTheGraphsOwnWithoutDrift)
{
	std::mt19937 rng(7);
	for (int n = 0; n < 20; n++) {
		const Matrix6d C = randomCovariance(rng, 0.3);
		EXPECT_LT(
			(largerOfGraphAndDrift(C, expSO3(randomVector(rng, 3)), Vector3d::Zero()) - C).norm(), 1e-12);
	}
}

TEST(LargerOfGraphAndDrift, northIsStarboardOfABodyThatLooksWest)
{
	// Heading west (yaw -90 deg): north is to starboard, the body's y axis.
	const Matrix3d R_map_body = rotationFromYawPitchRoll(-M_PI / 2, 0, 0);
	const Matrix6d C = largerOfGraphAndDrift(1e-6 * Matrix6d::Identity(), R_map_body, {0.25, 0, 0});
	EXPECT_NEAR(C(0, 0), 1e-6, 1e-12);
	EXPECT_NEAR(C(1, 1), 0.25, 1e-12);
	EXPECT_NEAR(C(2, 2), 1e-6, 1e-12);
}
