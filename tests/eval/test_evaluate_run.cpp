#include "eval_testing.h"

#include <posidonia/eval/evaluate_run.h>

using namespace posidonia;
using namespace posidonia::testing;

TEST(EvaluateRun, UnalignedComesFirstAndRowsHoldTheNumbers)
{
	std::mt19937 rng(18);
	const TTrajectory truth = smoothTrajectory(200, 100);
	Eigen::Isometry3d T_est_truth(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()));
	T_est_truth.translation() << 1, 2, 0.5;
	TTrajectory estimate;
	for (size_t i = 0; i < truth.size(); i += 2)
		estimate.push_back({truth[i].stamp, T_est_truth * truth[i].T * randomPose(rng, 0.01, 0.001)});
	estimate.push_back({500, Eigen::Isometry3d::Identity()});
	const TRunEvaluation run = evaluateRun("slam", estimate, truth);
	const auto value = [&](const std::string& what) { return metric(run.metrics, "slam." + what); };
	EXPECT_EQ(run.metrics[2].what, "slam.ate.unaligned.mean");
	EXPECT_EQ(value("poses"), 101);
	EXPECT_EQ(value("poses_with_truth"), 100);
	EXPECT_EQ(value("ate.unaligned.mean"), run.absolute[0].translation.mean);
	EXPECT_GT(value("ate.unaligned.rmse"), 1);
	EXPECT_LT(value("ate.yaw_position.rmse"), 0.02);
	EXPECT_LT(value("ate.se3.rmse"), value("ate.yaw_position.rmse"));
	EXPECT_LT(value("ate.origin.rmse"), 0.1);
	EXPECT_NEAR(value("ate.unaligned.rotation.mean"), 0.2 * 180 / M_PI, 0.05);
	EXPECT_NEAR(value("truth_length"), value("length"), 0.02 * value("length"));
	EXPECT_GT(value("truth_length_full_rate"), value("truth_length"))
		<< "shorter chords follow the curve better";
	EXPECT_EQ(value("end_error.unaligned"), run.absolute[0].poses.back().translation);
	EXPECT_LT(value("rpe.mean"), 0.05);
	for (const auto& row : run.metrics)
		EXPECT_TRUE(std::isfinite(row.value)) << row.what;
}

TEST(EvaluateRun, TwiceGivesTheSameBytes)
{
	const TTrajectory truth = smoothTrajectory(100, 0);
	const auto json = [&] { return metricsJson(evaluateRun("slam", truth, truth).metrics); };
	EXPECT_EQ(json(), json());
}

TEST(EvaluateRun, ThePerfectRunHasNoError)
{
	const TTrajectory truth = smoothTrajectory(100, 0);
	const TRunEvaluation run = evaluateRun("odom", truth, truth);
	for (EAlignment kind : kAlignments)
		EXPECT_LT(metric(run.metrics, "odom.ate." + alignmentName(kind) + ".max"), 1e-12)
			<< alignmentTitle(kind);
	EXPECT_EQ(run.length, run.truth_length);
}

TEST(EvaluateRun, AShortRunHasNoRelativeError)
{
	const TTrajectory truth = smoothTrajectory(5, 0);
	const TRunEvaluation run = evaluateRun("odom", truth, truth);
	EXPECT_EQ(metric(run.metrics, "odom.rpe.pieces"), 0);
	expectContains(errorOf([&] { metric(run.metrics, "odom.rpe.mean"); }), "no row");
}
