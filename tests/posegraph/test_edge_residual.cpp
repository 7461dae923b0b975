#include <gtest/gtest.h>
#include <numerical_derivative.h>
#include <posidonia/posegraph/edge_residual.h>
#include <random_pose.h>

#include <cmath>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
struct TCase
{
	TPoseEdge edge;
	Eigen::Isometry3d T_map_from, T_map_to;
	double residual_angle;
	Vector6d error{Vector6d::Zero()};  ///< value of the error variable
};

/** Edges whose residual rotation is 0 to 3.1 rad. */
std::vector<TCase> cases()
{
	std::mt19937 rng(7);
	std::vector<TCase> out;
	for (const double angle : {0.0, 1e-9, 1e-4, 0.1, 1.0, 2.0, 3.0, 3.1})
		for (int repeat = 0; repeat < 5; repeat++) {
			TCase c;
			c.residual_angle = angle;
			c.edge.from = 0;
			c.edge.to = 1;
			c.T_map_from = randomPose(rng, 10, 2);
			c.T_map_to = randomPose(rng, 10, 2);
			Vector6d d;
			d << randomVector(rng, 2), angle * randomVector(rng, 1).normalized();
			c.edge.T_from_to =
				(c.T_map_from.inverse() * c.T_map_to) * retract(Eigen::Isometry3d::Identity(), d);
			c.edge.information = randomCovariance(rng, 3);
			out.push_back(c);
			c.edge.error_variable = 2;
			c.edge.sensitivity = randomCovariance(rng, 1);
			c.error << randomVector(rng, 0.2), randomVector(rng, 0.2);
			c.edge.T_from_to = retract(c.edge.T_from_to, -c.edge.sensitivity * c.error);
			out.push_back(c);
		}
	return out;
}
}  // namespace

TEST(EdgeResidual, IsZeroForAPerfectMeasurementAndTwiceTheQuaternionOtherwise)
{
	TPoseEdge edge;
	EXPECT_EQ(
		edgeResidual(edge, Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity()),
		Vector6d(Vector6d::Zero()));
	Vector6d d;
	d << 1, 2, 3, 0, 0, 3;
	const Vector6d e =
		edgeResidual(edge, Eigen::Isometry3d::Identity(), retract(Eigen::Isometry3d::Identity(), d));
	const Vector6d expected = (Vector6d() << 1, 2, 3, 0, 0, 2 * std::sin(1.5)).finished();
	EXPECT_LT((e - expected).norm(), 1e-14);
}

TEST(EdgeResidual, IsThePerturbationOfTheMeasurementToFirstOrder)
{
	std::mt19937 rng(3);
	for (int i = 0; i < 20; i++) {
		const auto T_map_from = randomPose(rng, 5, 2), T_from_to = randomPose(rng, 5, 2);
		TPoseEdge edge;
		edge.T_from_to = T_from_to;
		const Vector6d d = 1e-6 * randomCovariance(rng, 1).col(0);
		const Vector6d e = edgeResidual(edge, T_map_from, T_map_from * retract(T_from_to, d));
		EXPECT_LT((e - d).norm(), 1e-10) << "i=" << i;
	}
}

TEST(EdgeResidual, JacobiansEqualNumericalDerivatives)
{
	for (const TCase& c : cases()) {
		const auto J = edgeJacobians(c.edge, c.T_map_from, c.T_map_to, c.error);
		const auto from = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
			return edgeResidual(c.edge, retract(c.T_map_from, d), c.T_map_to, c.error);
		};
		const auto to = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
			return edgeResidual(c.edge, c.T_map_from, retract(c.T_map_to, d), c.error);
		};
		const auto error = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
			return edgeResidual(c.edge, c.T_map_from, c.T_map_to, c.error + d);
		};
		const auto where = ::testing::Message()
						   << "angle=" << c.residual_angle << " error variable=" << c.edge.error_variable;
		EXPECT_LT((J.J_from - numericalDerivative(from, 6)).norm(), 1e-7) << where;
		EXPECT_LT((J.J_to - numericalDerivative(to, 6)).norm(), 1e-7) << where;
		EXPECT_LT((J.J_error - numericalDerivative(error, 6)).norm(), 1e-7) << where;
	}
}

TEST(EdgeResidual, NormalEquationsAreTheJacobiansSquared)
{
	for (const TCase& c : cases()) {
		const TNodeStates states{
			{c.T_map_from, c.T_map_to, Eigen::Isometry3d::Identity()},
			{Vector6d::Zero(), Vector6d::Zero(), c.error}};
		const auto J = edgeJacobians(c.edge, c.T_map_from, c.T_map_to, c.error);
		const auto N = linearizeEdge(c.edge, states);
		const Matrix6d& Omega = c.edge.information;
		const Matrix6d* jacobians[] = {&J.J_from, &J.J_to, &J.J_error};
		EXPECT_EQ(N.count, c.edge.error_variable < 0 ? 2 : 3);
		EXPECT_NEAR(N.s, J.e.dot(Omega * J.e), 1e-12 * (1 + N.s));
		EXPECT_NEAR(N.s, edgeMahalanobis2(c.edge, states), 1e-12 * (1 + N.s));
		const double scale = N.H[0].norm() + 1;
		for (int a = 0; a < N.count; a++) {
			const Vector6d g = jacobians[a]->transpose() * Omega * J.e;
			EXPECT_LT((N.g[a] - g).norm(), 1e-12 * scale * (1 + J.e.norm())) << "a=" << a;
			for (int b = 0; b <= a; b++) {
				const Matrix6d H = jacobians[a]->transpose() * Omega * *jacobians[b];
				EXPECT_LT((N.H[TFactorNormal::lower(a, b)] - H).norm(), 1e-12 * scale)
					<< "a=" << a << " b=" << b;
			}
		}
	}
}

TEST(RobustLoss, WeightIsTheDerivativeOfTheCost)
{
	for (const auto kind : {ERobustLoss::None, ERobustLoss::Huber, ERobustLoss::Cauchy, ERobustLoss::Dcs})
		for (const double s : {0.01, 1.0, 3.9, 4.1, 50.0, 1e4}) {
			const TRobustLoss loss{kind, 2.0, 0.7};
			const double h = 1e-5 * s;
			const double slope = (robustCost(loss, s + h) - robustCost(loss, s - h)) / (2 * h);
			EXPECT_NEAR(robustWeight(loss, s), slope, 1e-7) << "kind=" << int(kind) << " s=" << s;
			EXPECT_GT(robustWeight(loss, s), 0);
			EXPECT_LE(robustCost(loss, s), 0.7 * s * (1 + 1e-12));
		}
}
