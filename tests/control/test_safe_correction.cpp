#include <gtest/gtest.h>
#include <posidonia/control/delayed_corrections.h>
#include <posidonia/control/safe_correction.h>

#include <cmath>

using namespace posidonia;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
Isometry3d pose(double x, double y, double z, double yaw)
{
	Isometry3d T = Isometry3d::Identity();
	T.linear() = rotationFromYawPitchRoll(yaw, 0, 0);
	T.translation() = Vector3d(x, y, z);
	return T;
}

/** The vehicle by odometry: 0.3 m/s ahead from (10, 7), slowly turning. */
Isometry3d odometry(double t)
{
	return pose(10 + 0.3 * t, 7 + 0.05 * t, 3.5, 0.2 + 0.01 * t);
}

/** T_map_odom that moves the vehicle at odometry(t) by `jump` m and `turn` rad. */
Isometry3d correctionAt(double t, double jump, double turn)
{
	Vector6d d;
	d << 0, jump, 0, 0, 0, turn;
	return retract(odometry(t), d) * odometry(t).inverse();
}

double angle(const Isometry3d& a, const Isometry3d& b)
{
	return logSO3(a.linear().transpose() * b.linear()).norm();
}
}  // namespace

TEST(SafeCorrection, NothingToCorrectIsTheIdentity)
{
	CSafeCorrection safe{TControllerPoseOptions()};
	for (int i = 0; i < 50; i++) {
		safe.advance(0.1 * i, odometry(0.1 * i));
		EXPECT_TRUE(safe.T_map_odom().isApprox(Isometry3d::Identity(), 1e-15)) << "i=" << i;
		EXPECT_FALSE(safe.correcting());
	}
}

TEST(SafeCorrection, TheFirstTargetIsTakenAsItIs)
{
	CSafeCorrection safe{TControllerPoseOptions()};
	safe.setTarget(correctionAt(0, 3, 1));
	safe.advance(0, odometry(0));
	EXPECT_FALSE(safe.correcting());
	EXPECT_TRUE(safe.T_map_odom().isApprox(correctionAt(0, 3, 1), 1e-12));
}

TEST(SafeCorrection, AJumpIsBoundedAtTheVehicleAndConvergesInTime)
{
	const TControllerPoseOptions options;
	for (double jump : {0.02, 0.3, 1.0})
		for (double turn : {0.0, 1 * M_PI / 180, 5 * M_PI / 180, -5 * M_PI / 180}) {
			CSafeCorrection safe(options);
			safe.advance(0, odometry(0));
			safe.setTarget(correctionAt(0, jump, turn));
			double converged = -1;
			for (int i = 1; i < 600 && converged < 0; i++) {
				const double t = 0.1 * i;
				// What the pose would be without a correction in this step.
				const Isometry3d carried = safe.T_map_odom() * odometry(t);
				safe.advance(t, odometry(t));
				const double moved = (safe.T_map_body().translation() - carried.translation()).norm();
				EXPECT_LE(moved, 0.1 * options.position_rate + 1e-9) << jump << " " << turn << " t=" << t;
				EXPECT_LE(angle(safe.T_map_body(), carried), 0.1 * options.rotation_rate + 1e-9)
					<< jump << " " << turn << " t=" << t;
				EXPECT_TRUE((safe.T_map_odom() * odometry(t)).isApprox(safe.T_map_body(), 1e-9));
				if (!safe.correcting()) converged = t;
			}
			const double allowed =
				std::max(jump / options.position_rate, std::abs(turn) / options.rotation_rate) + 1;
			EXPECT_GT(converged, 0) << jump << " " << turn;
			EXPECT_LE(converged, allowed) << jump << " " << turn;
			EXPECT_TRUE(safe.T_map_odom().isApprox(correctionAt(0, jump, turn), 1e-9));
		}
}

TEST(SafeCorrection, ChasesATargetThatMovesMoreSlowlyThanTheLimit)
{
	CSafeCorrection safe{TControllerPoseOptions()};
	safe.advance(0, odometry(0));
	for (int i = 1; i < 300; i++) {
		const double t = 0.1 * i;
		safe.setTarget(pose(0.05 * t, 0, 0, 0));
		safe.advance(t, odometry(t));
		EXPECT_LT(safe.remaining().norm(), 1e-9) << "t=" << t;
	}
}

TEST(SafeCorrection, CovarianceGrowsByWhatIsNotYetApplied)
{
	const TControllerPoseOptions options;
	CSafeCorrection safe(options);
	safe.advance(0, odometry(0));
	safe.setTarget(correctionAt(0, 1, 0));
	safe.advance(1, odometry(0));
	ASSERT_TRUE(safe.correcting());
	const Matrix6d cov = 1e-4 * Matrix6d::Identity();
	const Matrix6d grown = safe.covariance(cov);
	const double left = 1 - options.position_rate;
	EXPECT_NEAR(grown(1, 1), 1e-4 + left * left, 1e-9);
	EXPECT_NEAR(grown(0, 0), 1e-4, 1e-9);
	EXPECT_TRUE(isPositiveDefinite(grown));
}

TEST(DelayedCorrections, BecomeVisibleAfterTheLatency)
{
	CDelayedCorrections queue(0.5);
	queue.push({1.0, pose(1, 0, 0, 0), Matrix6d::Zero()});
	queue.push({1.3, pose(2, 0, 0, 0), Matrix6d::Zero()});
	EXPECT_FALSE(queue.takeVisible(1.49));
	const auto first = queue.takeVisible(1.5);
	ASSERT_TRUE(first);
	EXPECT_EQ(first->stamp, 1.0);
	EXPECT_FALSE(queue.takeVisible(1.5)) << "seen once";
	EXPECT_EQ(queue.takeVisible(1.9)->T_map_odom.translation().x(), 2);
}

TEST(DelayedCorrections, OnlyTheNewestOfSeveralIsGiven)
{
	CDelayedCorrections queue(0);
	for (int i = 1; i <= 3; i++)
		queue.push({0.1 * i, pose(i, 0, 0, 0), Matrix6d::Zero()});
	EXPECT_EQ(queue.takeVisible(1)->T_map_odom.translation().x(), 3);
	EXPECT_FALSE(queue.takeVisible(2));
}
