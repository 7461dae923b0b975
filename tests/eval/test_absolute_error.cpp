#include "eval_testing.h"

#include <posidonia/eval/absolute_error.h>
#include <posidonia/eval/path.h>

using namespace posidonia;
using namespace posidonia::testing;

TEST(Statistics, OfValuesWorkedOutByHand)
{
	const TStatistics odd = statistics({3, 1, 8});
	EXPECT_EQ(odd.count, 3u);
	EXPECT_DOUBLE_EQ(odd.max, 8);
	EXPECT_DOUBLE_EQ(odd.min, 1);
	EXPECT_DOUBLE_EQ(odd.mean, 4);
	EXPECT_DOUBLE_EQ(odd.median, 3);
	EXPECT_DOUBLE_EQ(odd.sse, 74);
	EXPECT_DOUBLE_EQ(odd.rmse, std::sqrt(74.0 / 3));
	EXPECT_DOUBLE_EQ(odd.std, std::sqrt(26.0 / 3));
	EXPECT_DOUBLE_EQ(statistics({4, 1, 2, 8}).median, 3);
	EXPECT_EQ(statistics({}).count, 0u);
}

TEST(Statistics, RmseIsMeanAndStdTogether)
{
	std::mt19937 rng(12);
	std::vector<double> values;
	for (int i = 0; i < 1000; i++)
		values.push_back(randomVector(rng, 3).norm());
	const TStatistics s = statistics(values);
	EXPECT_NEAR(s.rmse * s.rmse, s.mean * s.mean + s.std * s.std, 1e-12);
}

/** Errors computed pose by pose with other means: homogeneous matrices and the trace formula of the angle. */
TEST(AbsoluteError, AgreesWithBruteForce)
{
	std::mt19937 rng(13);
	const TAssociation poses = noisyAssociation(rng, 70, randomPose(rng, 3, 0.5), 0.2, 0.1);
	for (EAlignment kind : kAlignments) {
		const TAbsoluteError result = absoluteError(poses, kind);
		ASSERT_EQ(result.poses.size(), poses.size());
		double sum = 0, distance = 0;
		for (size_t i = 0; i < poses.size(); i++) {
			const Eigen::Matrix4d truth = poses[i].T_truth_body.matrix();
			const Eigen::Matrix4d est = result.T_truth_est.matrix() * poses[i].T_est_body.matrix();
			const double error = (est.col(3) - truth.col(3)).norm();
			const double trace =
				(truth.topLeftCorner<3, 3>().transpose() * est.topLeftCorner<3, 3>()).trace();
			if (i > 0) distance += (truth.col(3) - poses[i - 1].T_truth_body.matrix().col(3)).norm();
			EXPECT_NEAR(result.poses[i].translation, error, 1e-12) << alignmentName(kind) << " i=" << i;
			EXPECT_NEAR(std::cos(result.poses[i].rotation), (trace - 1) / 2, 1e-12)
				<< alignmentName(kind) << " i=" << i;
			EXPECT_NEAR(result.poses[i].distance, distance, 1e-9) << alignmentName(kind) << " i=" << i;
			sum += error;
		}
		EXPECT_NEAR(result.translation.mean, sum / 70, 1e-12) << alignmentName(kind);
		EXPECT_EQ(result.endError(), result.poses.back().translation);
	}
}

TEST(AbsoluteError, PlantedBiasIsFoundInItsAxis)
{
	std::mt19937 rng(14);
	Eigen::Isometry3d T_est_truth = Eigen::Isometry3d::Identity();
	T_est_truth.translation() << 0.3, -0.4, 1.2;
	const TAbsoluteError result =
		absoluteError(noisyAssociation(rng, 30, T_est_truth, 0, 0), EAlignment::None);
	for (const auto& e : result.poses)
		EXPECT_LT((e.error - Eigen::Vector3d(0.3, -0.4, 1.2)).norm(), 1e-12);
	EXPECT_NEAR(result.translation.mean, 1.3, 1e-12);
	EXPECT_NEAR(result.translation.std, 0, 1e-7);
	EXPECT_NEAR(result.rotation.max, 0, 1e-7);
}

TEST(Path, LengthOfASquareAndOfAPartOfIt)
{
	TTrajectory square(5);
	const std::vector<Eigen::Vector3d> corners{{0, 0, 3}, {2, 0, 3}, {2, 2, 3}, {0, 2, 3}, {0, 0, 3}};
	for (size_t i = 0; i < 5; i++) {
		square[i].stamp = static_cast<double>(i);
		square[i].T.translation() = corners[i];
	}
	EXPECT_DOUBLE_EQ(pathLength(square), 8);
	EXPECT_DOUBLE_EQ(pathLength(square, 0.5, 3), 4);
	EXPECT_EQ(travelled(corners), (std::vector<double>{0, 2, 4, 6, 8}));
	EXPECT_EQ(pathLength({}), 0);
}
