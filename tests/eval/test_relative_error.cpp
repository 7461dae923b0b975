#include "eval_testing.h"

#include <posidonia/eval/relative_error.h>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** A straight line along x, `step` metres a pose; the estimate is longer by `scale` and turns by `yaw_rate` a
 * metre. */
TAssociation straightLine(int n, double step, double scale, double roll_rate)
{
	TAssociation poses(static_cast<size_t>(n));
	for (size_t i = 0; i < poses.size(); i++) {
		const double x = step * static_cast<double>(i);
		poses[i].stamp = static_cast<double>(i);
		poses[i].T_truth_body.translation().x() = x;
		poses[i].T_est_body.translation().x() = scale * x;
		poses[i].T_est_body.linear() = rotationFromYawPitchRoll(0, 0, roll_rate * x);
	}
	return poses;
}
}  // namespace

TEST(RelativeError, PlantedScaleAndRollRateComeBack)
{
	const TRelativeError e = relativeError(straightLine(101, 0.5, 1.02, 0.01));
	EXPECT_EQ(e.translation.count, 81u);  // 50 m, pieces of 20 steps
	EXPECT_NEAR(e.translation.mean, 0.2, 1e-12);
	EXPECT_NEAR(e.translation.max, 0.2, 1e-12);
	EXPECT_NEAR(e.rotation.mean, 0.1, 1e-9);
	EXPECT_NEAR(e.drift.mean, 0.02, 1e-12);
}

TEST(RelativeError, DeltaInFramesAndInMetres)
{
	TRelativeErrorOptions options;
	options.unit = "frames";
	options.delta = 4;
	EXPECT_NEAR(relativeError(straightLine(50, 0.5, 1.1, 0), options).translation.mean, 0.2, 1e-12);
	options.delta = 49;
	EXPECT_EQ(relativeError(straightLine(50, 0.5, 1.1, 0), options).translation.count, 1u);
	options.unit = "m";
	options.delta = 1.2;  // the first pose at least that far is 1.5 m away
	EXPECT_NEAR(relativeError(straightLine(50, 0.5, 1.1, 0), options).translation.mean, 0.15, 1e-12);
	options.delta = 100;
	EXPECT_EQ(relativeError(straightLine(50, 0.5, 1.1, 0), options).translation.count, 0u);
}

TEST(RelativeError, AgreesWithBruteForceAndIgnoresTheWorlds)
{
	std::mt19937 rng(15);
	const TAssociation poses = noisyAssociation(rng, 60, randomPose(rng, 3, 0.5), 0.2, 0.1);
	TRelativeErrorOptions options;
	options.delta = 3;
	std::vector<double> expected;
	for (size_t i = 0; i < poses.size(); i++) {
		double path = 0;
		for (size_t j = i + 1; j < poses.size(); j++) {
			path += (poses[j].T_truth_body.translation() - poses[j - 1].T_truth_body.translation()).norm();
			if (path < 3) continue;
			const Eigen::Matrix4d truth =
				poses[i].T_truth_body.matrix().inverse() * poses[j].T_truth_body.matrix();
			const Eigen::Matrix4d est = poses[i].T_est_body.matrix().inverse() * poses[j].T_est_body.matrix();
			expected.push_back(Eigen::Matrix4d(truth.inverse() * est).topRightCorner<3, 1>().norm());
			break;
		}
	}
	const TRelativeError e = relativeError(poses, options);
	EXPECT_EQ(e.translation.count, expected.size());
	EXPECT_NEAR(e.translation.rmse, statistics(expected).rmse, 1e-10);
	TAssociation moved = poses;
	const Eigen::Isometry3d T = randomPose(rng, 50, 2);
	for (auto& p : moved)
		p.T_est_body = T * p.T_est_body;
	EXPECT_NEAR(relativeError(moved, options).translation.rmse, e.translation.rmse, 1e-10);
}
