#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/nav/recorded_odometry.h>
#include <posidonia/obs/observations.h>

using namespace posidonia;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
/** Half a metre a second along x, turning. */
Isometry3d poseAt(double t)
{
	Isometry3d T = Isometry3d::Identity();
	T.translation() = Vector3d(0.5 * t, 0, 1);
	T.linear() = expSO3({0, 0, 0.1 * t});
	return T;
}
mrpt::obs::CObservationRobotPose robotPose(double t, const std::string& label = "ODOMETRY")
{
	mrpt::obs::CObservationRobotPose o;
	o.sensorLabel = label;
	o.timestamp = stampFrom(1e9 + t);
	o.pose = toMrptGaussian(poseAt(t), 1e-4 * Matrix6d::Identity());
	return o;
}
mrpt::obs::CObservationStereoImages stereoAt(double t)
{
	mrpt::obs::CObservationStereoImages o;
	o.timestamp = stampFrom(1e9 + t);
	return o;
}
double distance(const Isometry3d& a, const Isometry3d& b)
{
	return (a.matrix() - b.matrix()).norm();
}
}  // namespace

TEST(RecordedOdometry, PosesPassThrough)
{
	CRecordedOdometry odometry({});
	EXPECT_FALSE(odometry.ready());
	for (double t = 0; t < 5; t += 0.25) {
		odometry.add(robotPose(t));
		odometry.add(robotPose(t + 7, "GROUND_TRUTH"));
		EXPECT_LT(distance(odometry.now().T, poseAt(t)), 1e-9) << "t=" << t;
		EXPECT_NEAR(odometry.stamp(), 1e9 + t, 1e-6);
	}
	EXPECT_TRUE(odometry.ready());
	EXPECT_NEAR(odometry.now().path_length, 0.5 * 4.75, 1e-9);
	EXPECT_LT(distance(odometry.sinceClone().T, poseAt(0).inverse() * poseAt(4.75)), 1e-9);
}

TEST(RecordedOdometry, MotionIsThatBetweenTheLastTwoPosesInBodyAxes)
{
	CRecordedOdometry odometry({});
	odometry.add(robotPose(0));
	EXPECT_TRUE(odometry.motion().velocity.isZero(0));
	odometry.add(robotPose(0.25));
	const auto motion = odometry.motion();
	const Vector3d expected = poseAt(0.25).linear().transpose() * Vector3d(0.5, 0, 0);
	EXPECT_LT((motion.velocity - expected).norm(), 1e-6) << motion.velocity.transpose();
	EXPECT_LT((motion.rate - Vector3d(0, 0, 0.1)).norm(), 1e-6) << motion.rate.transpose();
}

TEST(RecordedOdometry, StereoStampsAreInterpolatedOrExtrapolatedForAWhile)
{
	CRecordedOdometry odometry({});
	for (double t : {0.0, 1.0, 2.0, 3.0})
		odometry.add(robotPose(t));
	for (double t : {0.4, 1.7, 3.0, 3.3}) {
		odometry.add(stereoAt(t));
		EXPECT_LT(distance(odometry.now().T, poseAt(t)), 1e-6) << "t=" << t;  // stamps are ticks of 100 ns
		EXPECT_NEAR(odometry.stamp(), 1e9 + t, 1e-6) << "t=" << t;
	}
	EXPECT_EQ(odometry.stale(), 0u);
	odometry.add(stereoAt(5));	// held at half a second beyond the last pose
	EXPECT_LT(distance(odometry.now().T, poseAt(3.5)), 1e-9);
	EXPECT_EQ(odometry.stale(), 1u);
}

TEST(RecordedOdometry, EdgesAreDisplacementsWithTheirOwnCovariance)
{
	TRecordedOdometryOptions options;
	CRecordedOdometry odometry(options);
	odometry.add(robotPose(0));
	odometry.add(robotPose(1));
	odometry.clone();
	EXPECT_EQ(odometry.sinceClone().cov.norm(), 0);
	odometry.add(robotPose(3));
	const TPoseEstimate edge = odometry.sinceClone();
	EXPECT_LT(distance(edge.T, poseAt(1).inverse() * poseAt(3)), 1e-9);
	EXPECT_NEAR(edge.path_length, 1, 1e-9);
	EXPECT_NEAR(
		edge.cov(0, 0), std::pow(options.sigma_translation, 2) + std::pow(options.sigma_floor, 2), 1e-12);
	EXPECT_NEAR(
		edge.cov(5, 5), std::pow(options.sigma_rotation, 2) + std::pow(options.sigma_floor, 2), 1e-12);
}

TEST(RecordedOdometry, CovarianceOfTheObservationsOnRequest)
{
	TRecordedOdometryOptions options;
	options.covariance = "observation";
	CRecordedOdometry odometry(options);
	odometry.add(robotPose(0));
	odometry.clone();
	odometry.add(robotPose(1));
	EXPECT_LT((odometry.now().cov - 1e-4 * Matrix6d::Identity()).norm(), 1e-9);
	EXPECT_NEAR(odometry.sinceClone().cov(5, 5), 2e-4, 1e-9);
	EXPECT_GT(odometry.sinceClone().cov(1, 1), 2e-4);  // the clone's heading error swings the displacement
}

TEST(RecordedOdometry, LateStampsAreDroppedAndCounted)
{
	CRecordedOdometry odometry({});
	odometry.add(robotPose(1));
	odometry.add(robotPose(2));
	odometry.add(robotPose(1.5));
	EXPECT_EQ(odometry.late(), 1u);
	odometry.add(stereoAt(0.5));  // before the history
	EXPECT_EQ(odometry.late(), 2u);
	EXPECT_LT(distance(odometry.now().T, poseAt(2)), 1e-9);
}
