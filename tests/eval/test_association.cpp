#include "eval_testing.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** Constant velocity and yaw rate: interpolation is exact. */
TStampedPose truthAt(double t)
{
	TStampedPose pose{t, Eigen::Isometry3d::Identity()};
	pose.T.linear() = rotationFromYawPitchRoll(0.4 * t, 0, 0);
	pose.T.translation() << 0.3 * t, -0.1 * t, 3.5;
	return pose;
}

TTrajectory truth(double from, double step, int n)
{
	TTrajectory trajectory;
	for (int i = 0; i < n; i++)
		trajectory.push_back(truthAt(from + step * i));
	return trajectory;
}
}  // namespace

TEST(Association, InterpolatesTheTruthAtTheEstimatesStamps)
{
	const TTrajectory estimate = truth(1.07, 0.313, 20);
	const TAssociation poses = associate(estimate, truth(0, 0.25, 100));
	ASSERT_EQ(poses.size(), 20u);
	for (size_t i = 0; i < poses.size(); i++) {
		EXPECT_EQ(poses[i].index, i);
		EXPECT_LT((poses[i].T_truth_body.matrix() - truthAt(poses[i].stamp).T.matrix()).norm(), 1e-12)
			<< "i=" << i;
	}
}

TEST(Association, LeavesOutWhatTheTruthDoesNotCover)
{
	TTrajectory with_hole = truth(0, 0.1, 20);	// 0 ... 1.9 s
	for (const auto& p : truth(5, 0.1, 20))
		with_hole.push_back(p);	 // 5 ... 6.9 s
	const TTrajectory estimate{truthAt(-1),	  truthAt(0),	  truthAt(1.9), truthAt(3),
							   truthAt(5.05), truthAt(6.905), truthAt(8)};
	std::vector<size_t> kept;
	for (const auto& p : associate(estimate, with_hole))
		kept.push_back(p.index);
	// 6.905 s is 5 ms after the last true pose: the nearest one is taken, within max_dt.
	EXPECT_EQ(kept, (std::vector<size_t>{1, 2, 4, 5}));
}

TEST(Association, GapIsAnOption)
{
	TAssociationOptions options;
	const TTrajectory estimate{truthAt(0), truthAt(0.5)}, sparse{truthAt(0), truthAt(1)};
	EXPECT_EQ(associate(estimate, sparse, options).size(), 1u);
	options.max_gap = 1.01;
	EXPECT_EQ(associate(estimate, sparse, options).size(), 2u);
}

TEST(Association, NearestTakesTheCloserNeighbourWithinMaxDt)
{
	TAssociationOptions options;
	options.method = "nearest";
	options.max_dt = 0.04;
	const TTrajectory estimate{truthAt(1.03), truthAt(1.05), truthAt(1.08)};
	const TAssociation poses = associate(estimate, truth(0, 0.1, 30), options);
	ASSERT_EQ(poses.size(), 2u);  // 1.05 s is 0.05 s from both
	EXPECT_NEAR(poses[0].T_truth_body.translation().x(), 0.3 * 1.0, 1e-12);
	EXPECT_NEAR(poses[1].T_truth_body.translation().x(), 0.3 * 1.1, 1e-12);
}

TEST(Association, SaysBothSpansWhenNothingFits)
{
	const std::string error = errorOf([] { associate(truth(100, 1, 3), truth(0, 0.1, 11)); });
	expectContains(error, "100.000 ... 102.000 s");
	expectContains(error, "0.000 ... 1.000 s");
}

TEST(Association, RefusesStampsThatGoBackwards)
{
	TTrajectory backwards = truth(0, 0.1, 10);
	std::swap(backwards[4], backwards[5]);
	expectContains(errorOf([&] { associate(backwards, truth(0, 0.1, 10)); }), "estimate, pose 5");
	expectContains(errorOf([&] { associate(truth(0, 0.1, 10), backwards); }), "truth, pose 5");
}
