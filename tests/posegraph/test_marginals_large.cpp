#include <gtest/gtest.h>
#include <posidonia/posegraph/edge_residual.h>
#include <posidonia/posegraph/prior_residual.h>
#include <posidonia/posegraph/sparse_optimizer.h>
#include <synthetic_graphs.h>

#include <Eigen/Dense>

#include "random_graph.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
constexpr int kPoses = 500;

/** A survey with loops, priors of several kinds, a shared error of the odometry and a fixed node. */
CPoseGraph largeGraph()
{
	TLawnMower survey;
	survey.nodes = kPoses;
	survey.track = 40;
	survey.tracks_a_block = 6;
	auto out = lawnMower(survey);
	out.graph.setFixed(0, false);
	out.graph.setFixed(333, true);
	for (int i = 0; i < kPoses; i += 3) {
		out.graph.addPrior(priorOn(i, EPriorKind::Depth, out.planted[size_t(i)], 0.02));
		out.graph.addPrior(priorOn(i, EPriorKind::RollPitch, out.planted[size_t(i)], 0.01));
		if (i % 30 == 0) out.graph.addPrior(priorOn(i, EPriorKind::Heading, out.planted[size_t(i)], 0.05));
	}
	out.graph.addPrior(priorOn(7, EPriorKind::FullPose, out.planted[7], 0.1));
	const int error = out.graph.addErrorVariable(Vector6d::Zero(), 1e4 * Matrix6d::Identity());
	const int measured = int(out.graph.edgeCount());
	for (int k = 0; k < measured; k++) {
		TPoseEdge edge = out.graph.edge(k);
		if (edge.to % 50 != 1) continue;
		edge.error_variable = error;
		edge.sensitivity = Matrix6d::Identity();
		out.graph.addEdge(edge);
	}
	return std::move(out.graph);
}

/** The Hessian of all nodes, fixed ones included, summed from the Jacobians. */
Eigen::MatrixXd denseHessian(const CPoseGraph& graph)
{
	const int n = int(graph.nodeCount());
	Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6 * n, 6 * n);
	const auto add = [&](const std::vector<std::pair<int, Matrix6d>>& J, const Matrix6d& information) {
		for (const auto& [a, J_a] : J)
			for (const auto& [b, J_b] : J)
				H.block<6, 6>(6 * a, 6 * b) += J_a.transpose() * information * J_b;
	};
	for (const TPoseEdge& edge : graph.edges()) {
		const Vector6d c =
			edge.error_variable < 0 ? Vector6d::Zero() : graph.errorVariable(edge.error_variable);
		const auto J = edgeJacobians(edge, graph.pose(edge.from), graph.pose(edge.to), c);
		std::vector<std::pair<int, Matrix6d>> parts{{edge.from, J.J_from}, {edge.to, J.J_to}};
		if (edge.error_variable >= 0) parts.push_back({edge.error_variable, J.J_error});
		add(parts, edge.information);
	}
	for (const TPosePrior& prior : graph.priors()) {
		const auto J = priorJacobians(prior, graph.states());
		const int rows = priorDimension(prior.kind);
		Matrix6d information = Matrix6d::Zero(), J_node = Matrix6d::Zero();
		information.topLeftCorner(rows, rows) = prior.information.topLeftCorner(rows, rows);
		J_node.topRows(rows) = J.J_node.topRows(rows);
		add({{prior.node, J_node}}, information);
	}
	return H;
}

/** Columns of the dense inverse, zero for the fixed node. */
class LargeMarginals : public ::testing::Test
{
   protected:
	static void SetUpTestSuite()
	{
		s_graph = new CPoseGraph(largeGraph());
		CSparseOptimizer().optimize(*s_graph);
		std::vector<int> free;
		for (int i = 0; i < int(s_graph->nodeCount()); i++)
			for (int k = 0; k < 6 && !s_graph->isFixed(i); k++)
				free.push_back(6 * i + k);
		const Eigen::MatrixXd H = denseHessian(*s_graph);
		const Eigen::LLT<Eigen::MatrixXd> llt(H(free, free));
		const int n = int(free.size());
		Eigen::MatrixXd units = Eigen::MatrixXd::Zero(n, 6 * int(nodes().size()));
		for (size_t k = 0; k < nodes().size(); k++)
			for (int r = 0; r < n; r++)
				if (free[size_t(r)] / 6 == nodes()[k]) units(r, int(6 * k) + free[size_t(r)] % 6) = 1;
		const Eigen::MatrixXd columns = llt.solve(units);
		s_columns = new Eigen::MatrixXd(Eigen::MatrixXd::Zero(H.rows(), columns.cols()));
		for (int r = 0; r < n; r++)
			s_columns->row(free[size_t(r)]) = columns.row(r);
	}
	static void TearDownTestSuite()
	{
		delete s_graph;
		delete s_columns;
	}
	/** Of which the columns are there; the error variable is the last. */
	static const std::vector<int>& nodes()
	{
		static const std::vector<int> out = [] {
			std::vector<int> list{333, 1, 2, 499, 500};
			for (int i = 0; i < kPoses; i += 17)
				list.push_back(i);
			return list;
		}();
		return out;
	}
	static Matrix6d dense(int i, size_t k) { return s_columns->block<6, 6>(6 * i, int(6 * k)); }
	static double errorOf(const Eigen::MatrixXd& got, const Eigen::MatrixXd& expected)
	{
		return (got - expected).norm() / std::max(expected.norm(), 1e-12);
	}

	static CPoseGraph* s_graph;
	static Eigen::MatrixXd* s_columns;
	CSparseOptimizer optimizer;
};
CPoseGraph* LargeMarginals::s_graph = nullptr;
Eigen::MatrixXd* LargeMarginals::s_columns = nullptr;
}  // namespace

TEST_F(LargeMarginals, OneAndAllCovariancesEqualTheDenseInverse)
{
	const auto marginals = optimizer.marginals(*s_graph);
	const auto all = marginals.allCovariances();
	ASSERT_EQ(int(all.size()), kPoses + 1);
	for (size_t k = 0; k < nodes().size(); k++) {
		const int node = nodes()[k];
		EXPECT_LT(errorOf(marginals.covarianceOf(node), dense(node, k)), 1e-8) << "node " << node;
		EXPECT_LT(errorOf(all[size_t(node)], dense(node, k)), 1e-8) << "node " << node;
	}
	for (int i = 0; i <= kPoses; i++)
		EXPECT_LT(errorOf(all[size_t(i)], marginals.covarianceOf(i)), 1e-8) << "node " << i;
	EXPECT_TRUE(all[333].isZero()) << "the fixed node";
}

TEST_F(LargeMarginals, JointAndRelativeCovariancesEqualTheDenseInverse)
{
	const auto marginals = optimizer.marginals(*s_graph);
	for (size_t k = 0; k < nodes().size(); k++) {
		const size_t other = (5 * k + 3) % nodes().size();
		const int i = nodes()[k], j = nodes()[other];
		Eigen::Matrix<double, 12, 12> joint;
		joint << dense(i, k), dense(i, other), dense(j, k), dense(j, other);
		EXPECT_LT(errorOf(marginals.jointCovariance({i, j}), joint), 1e-8) << i << ", " << j;
		if (i == kPoses || j == kPoses) continue;
		Eigen::Matrix<double, 6, 12> J;
		J << -adjoint(s_graph->pose(j).inverse() * s_graph->pose(i)), Matrix6d::Identity();
		// To 1e-8 of what it is the small difference of.
		const Matrix6d relative = J * joint * J.transpose();
		EXPECT_LT(
			(marginals.relativeCovariance(i, j) - relative).norm(),
			1e-8 * std::max(relative.norm(), joint.norm()))
			<< i << ", " << j;
	}
}
