#include <gtest/gtest.h>
#include <posidonia/posegraph/robust_loss.h>

#include <Eigen/Dense>
#include <random>

using namespace posidonia;

namespace
{
using TVector = Eigen::Matrix<double, 6, 1>;

/** Mean of `count` measurements of zero with unit covariance, by iteratively re-weighted least squares; and
 * the sum of the weights there, the information that the normal equations state. */
struct TEstimate
{
	TVector mean;
	double information;
};

TEstimate estimate(const TRobustLoss& loss, int count, std::mt19937& rng)
{
	std::normal_distribution<double> normal;
	Eigen::Matrix<double, 6, Eigen::Dynamic> z(6, count);
	for (int k = 0; k < z.size(); k++)
		z.data()[k] = normal(rng);
	TEstimate out{z.rowwise().mean(), 0};
	for (int iteration = 0; iteration < 20; iteration++) {
		TVector sum = TVector::Zero();
		out.information = 0;
		for (int k = 0; k < count; k++) {
			const double w = robustWeight(loss, (z.col(k) - out.mean).squaredNorm());
			sum += w * z.col(k);
			out.information += w;
		}
		out.mean = sum / out.information;
	}
	return out;
}

double anees(const TRobustLoss& loss)
{
	std::mt19937 rng(1);
	constexpr int kTrials = 1500;
	double sum = 0;
	for (int k = 0; k < kTrials; k++) {
		const TEstimate e = estimate(loss, 60, rng);
		sum += e.information * e.mean.squaredNorm() / 6;
	}
	return sum / kTrials;
}
}  // namespace

TEST(RobustLoss, HonestFactorIsOneWithoutALoss)
{
	for (const int dof : {1, 2, 3, 6})
		EXPECT_NEAR(honestFactor({}, dof), 1, dof == 1 ? 2e-2 : 1e-6) << dof;
	EXPECT_NEAR(honestFactor({ERobustLoss::Cauchy, 100}, 6), 1, 2e-3);
}

/** 95 % of the means of 1500 chi-squares of 6 degrees of freedom lie within 3 % of 1. */
TEST(RobustLoss, HonestFactorMakesTheStatedInformationHonest)
{
	for (const auto kind : {ERobustLoss::Huber, ERobustLoss::Cauchy, ERobustLoss::Dcs})
		for (const double scale : {2.0, 4.0}) {
			TRobustLoss loss{kind, scale};
			const double without = anees(loss);
			loss.weight = honestFactor(loss, 6);
			EXPECT_NEAR(anees(loss), 1, 0.05) << "kind=" << int(kind) << " scale=" << scale;
			EXPECT_LE(without, 1.03) << "kind=" << int(kind) << " scale=" << scale;
			if (kind == ERobustLoss::Cauchy) {
				EXPECT_LT(without, scale < 3 ? 0.6 : 0.9);
			}
		}
}
