#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/edge_residual.h>
#include <posidonia/posegraph/sparse_optimizer.h>

#include "random_graph.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** The covariance of all nodes by the dense inverse of the Hessian summed from the Jacobians; a fixed node's
 * zero. */
Eigen::MatrixXd denseCovariance(const CPoseGraph& graph)
{
	const int n = int(graph.nodeCount());
	Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6 * n, 6 * n);
	for (const TPoseEdge& edge : graph.edges()) {
		const auto J = edgeJacobians(edge, graph.pose(edge.from), graph.pose(edge.to));
		Eigen::MatrixXd row = Eigen::MatrixXd::Zero(6, 6 * n);
		row.middleCols<6>(6 * edge.from) = J.J_from;
		row.middleCols<6>(6 * edge.to) = J.J_to;
		H += robustWeight(edge.loss, J.e.dot(edge.information * J.e)) * row.transpose() * edge.information *
			 row;
	}
	std::vector<int> free;
	for (int i = 0; i < n; i++)
		for (int k = 0; k < 6 && !graph.isFixed(i); k++)
			free.push_back(6 * i + k);
	const Eigen::MatrixXd inverse = Eigen::MatrixXd(H(free, free)).inverse();
	Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6 * n, 6 * n);
	for (size_t a = 0; a < free.size(); a++)
		for (size_t b = 0; b < free.size(); b++)
			out(free[a], free[b]) = inverse(int(a), int(b));
	return out;
}

Matrix6d denseRelative(const CPoseGraph& graph, const Eigen::MatrixXd& cov, int i, int j)
{
	const Matrix6d Ad = adjoint(graph.pose(j).inverse() * graph.pose(i));
	Eigen::Matrix<double, 6, 12> J;
	J << -Ad, Matrix6d::Identity();
	Eigen::Matrix<double, 12, 12> joint;
	joint << cov.block<6, 6>(6 * i, 6 * i), cov.block<6, 6>(6 * i, 6 * j), cov.block<6, 6>(6 * j, 6 * i),
		cov.block<6, 6>(6 * j, 6 * j);
	return J * joint * J.transpose();
}

class Marginals : public ::testing::Test
{
   protected:
	Marginals() : planted(plantedGraph(17, 40, 50, 0.3, true))
	{
		planted.graph.setFixed(20, true);
		for (int k = 50; k < 60; k++)
			planted.graph.setLoss(k, {ERobustLoss::Cauchy, 1.0});
		optimizer.optimize(planted.graph);
		dense = denseCovariance(planted.graph);
	}
	TPlantedGraph planted;
	CSparseOptimizer optimizer;
	Eigen::MatrixXd dense;
};
}  // namespace

TEST_F(Marginals, CovarianceEqualsTheDenseInverse)
{
	const auto marginals = optimizer.marginals(planted.graph);
	for (int i = 0; i < 40; i++)
		EXPECT_LT((marginals.covarianceOf(i) - dense.block<6, 6>(6 * i, 6 * i)).norm(), 1e-8 * dense.norm())
			<< "node " << i;
	EXPECT_TRUE(marginals.covarianceOf(0).isZero());
}

TEST_F(Marginals, JointCovarianceEqualsTheDenseInverse)
{
	const auto joint = optimizer.marginals(planted.graph).jointCovariance({31, 0, 4});
	const std::vector<int> nodes{31, 0, 4};
	for (int a = 0; a < 3; a++)
		for (int b = 0; b < 3; b++)
			EXPECT_LT(
				(joint.block<6, 6>(6 * a, 6 * b) - dense.block<6, 6>(6 * nodes[a], 6 * nodes[b])).norm(),
				1e-8 * dense.norm())
				<< nodes[a] << "," << nodes[b];
}

TEST_F(Marginals, RelativeCovarianceEqualsTheDenseInverse)
{
	const auto marginals = optimizer.marginals(planted.graph);
	std::vector<int> is;
	for (int i = 0; i < 40; i++)
		is.push_back(i);
	const auto batch = marginals.relativeCovariances(is, 33);
	ASSERT_EQ(batch.size(), 40u);
	for (int i = 0; i < 40; i++) {
		const Matrix6d expected = denseRelative(planted.graph, dense, i, 33);
		EXPECT_LT((batch[i] - expected).norm(), 1e-8 * dense.norm()) << "i=" << i;
		EXPECT_LT((batch[i] - marginals.relativeCovariance(i, 33)).norm(), 1e-12 * dense.norm()) << "i=" << i;
	}
	EXPECT_LT(batch[33].norm(), 1e-12 * dense.norm()) << "a node relative to itself";
}

TEST_F(Marginals, OfASingleEdgeIsTheEdges)
{
	auto chain = plantedGraph(3, 3, 0, 0.1, true);
	CSparseOptimizer solver;
	solver.optimize(chain.graph);
	const auto marginals = solver.marginals(chain.graph);
	for (int k = 0; k < 2; k++) {
		const Matrix6d expected = chain.graph.edge(k).information.inverse();
		EXPECT_LT((marginals.relativeCovariance(k, k + 1) - expected).norm(), 1e-9 * expected.norm())
			<< "k=" << k;
	}
}

TEST_F(Marginals, RefusesToSpeakOfAnOldFactor)
{
	const auto marginals = optimizer.marginals(planted.graph);
	EXPECT_NO_THROW(marginals.covarianceOf(3));
	EXPECT_THROW(marginals.covarianceOf(40), CError);
	optimizer.marginals(planted.graph);
	EXPECT_THROW(marginals.covarianceOf(3), CError);
}

/** The covariance is honest: over seeds, the error of the estimate has the covariance claimed. */
TEST(MarginalsNees, IsInItsBand)
{
	double sum = 0;
	int count = 0;
	for (unsigned seed = 0; seed < 60; seed++) {
		auto planted = plantedGraph(seed, 15, 10, 0.01, true);
		CSparseOptimizer optimizer;
		optimizer.optimize(planted.graph);
		const auto marginals = optimizer.marginals(planted.graph);
		const Vector6d d = localCoordinates(planted.graph.pose(14), planted.truth[14]);
		sum += d.dot(marginals.covarianceOf(14).ldlt().solve(d));
		count++;
	}
	EXPECT_NEAR(sum / count, 6, 4 * std::sqrt(12.0 / count)) << "4 sigma of the mean of chi-squares";
}
