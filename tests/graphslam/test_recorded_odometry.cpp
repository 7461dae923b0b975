// Poses recorded in the log in place of the filter.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/nav/recorded_odometry.h>

#include "survey.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using mrpt::obs::CObservationStereoImages;

namespace
{
/** The truth with 1 % of scale error and half a degree of heading a metre. */
std::vector<Isometry3d> drifting(const std::vector<Isometry3d>& truth)
{
	std::vector<Isometry3d> poses{truth.front()};
	for (size_t k = 1; k < truth.size(); k++) {
		Isometry3d step = truth[k - 1].inverse() * truth[k];
		const double way = step.translation().norm();
		step.translation() *= 1.01;
		step.linear() = step.linear() * expSO3({0, 0, 0.5 * M_PI / 180 * way});
		poses.push_back(poses.back() * step);
	}
	return poses;
}

mrpt::obs::CObservation::Ptr poseObservation(double stamp, const Isometry3d& T_odom_body)
{
	auto o = mrpt::obs::CObservationRobotPose::Create();
	o->sensorLabel = "ODOMETRY";
	o->timestamp = stampFrom(stamp);
	o->pose.mean = toMrpt(T_odom_body);
	o->pose.cov.setIdentity();
	return o;
}
}  // namespace

TEST(RecordedOdometry, drivesTheEngine)
{
	const TSurvey& s = survey();
	std::vector<Isometry3d> truth;
	for (double stamp : s.pair_stamps)
		truth.push_back(s.truth(stamp));
	const auto recorded = drifting(truth);

	TSetup setup;
	CStereoSlam slam(
		setup.slam, s.sensors, std::make_unique<CRecordedOdometry>(TRecordedOdometryOptions{}),
		std::make_unique<CStereoImageLoader>(s.rawlog));
	size_t k = 0;
	for (const auto& observation : s.observations) {
		if (!IS_CLASS(*observation, CObservationStereoImages)) continue;
		slam.add(poseObservation(s.pair_stamps[k], recorded[k]));
		slam.add(observation);
		EXPECT_LT(localCoordinates(recorded[k], slam.now().T_odom_body).norm(), 1e-6) << "pair " << k;
		k++;
	}
	EXPECT_LT(localCoordinates(recorded[0], slam.map().pose(0)).norm(), 1e-6);
	EXPECT_GT(edgesOf(slam, EEdgeKind::ROI), 0);
	const double odometry = meanOdometryError(slam), nodes = meanNodeError(slam);
	std::printf("[   INFO   ] mean error: recorded %.4f m, SLAM %.4f m\n", odometry, nodes);
	EXPECT_GT(odometry, 0.05);
	EXPECT_LT(nodes, odometry / 3);
}
