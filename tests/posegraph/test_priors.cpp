#include <gtest/gtest.h>
#include <numerical_derivative.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/g2o_file.h>
#include <posidonia/posegraph/prior_residual.h>
#include <posidonia/posegraph/spanning_tree.h>
#include <posidonia/posegraph/sparse_optimizer.h>
#include <temp_folder.h>

#include "random_graph.h"

#include <cstdio>
#include <functional>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
const std::vector<EPriorKind> kPoseKinds = {
	EPriorKind::Position, EPriorKind::HorizontalPosition, EPriorKind::Depth,   EPriorKind::RollPitch,
	EPriorKind::Heading,  EPriorKind::Attitude,			  EPriorKind::FullPose};

Matrix6d isotropic(double sigma)
{
	return Matrix6d::Identity() / (sigma * sigma);
}

/** A prior of each kind near a random pose, without and with an error variable (node 1). */
struct TPriorCase
{
	TPosePrior prior;
	TNodeStates states;
};

std::vector<TPriorCase> priorCases()
{
	std::mt19937 rng(5);
	std::vector<TPriorCase> out;
	for (const EPriorKind kind : kPoseKinds)
		for (const double angle : {0.0, 1e-6, 0.1, 1.0, 1.7})
			for (const int error_variable : {-1, 1}) {
				const auto T = randomPose(rng, 5, 2);
				CPoseGraph graph;
				graph.addNode(T);
				graph.addErrorVariable(
					(Vector6d() << randomVector(rng, 0.2), randomVector(rng, 0.2)).finished(), isotropic(1));
				Eigen::Isometry3d measured = T;
				measured.translation() += randomVector(rng, 1);
				measured.linear() = expSO3(angle * randomVector(rng, 1).normalized()) * T.linear();
				TPosePrior prior = priorOn(0, kind, measured, 1);
				prior.information = randomCovariance(rng, 1);
				prior.error_variable = error_variable;
				prior.sensitivity = randomCovariance(rng, 0.7);
				graph.addPrior(prior);
				out.push_back({graph.priors().back(), graph.states()});
			}
	return out;
}

TNodeStates moved(TNodeStates states, ENodeKind kind, int node, const Vector6d& d)
{
	retractNode(kind, d, node, states);
	return states;
}
}  // namespace

TEST(PriorResidual, JacobiansEqualNumericalDerivatives)
{
	for (const TPriorCase& c : priorCases()) {
		const auto J = priorJacobians(c.prior, c.states);
		const auto node = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
			return priorResidual(c.prior, moved(c.states, ENodeKind::Pose, 0, d));
		};
		const auto error = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
			return priorResidual(c.prior, moved(c.states, ENodeKind::ErrorVariable, 1, d));
		};
		const auto where = ::testing::Message() << toString(c.prior.kind) << ", e=" << J.e.transpose()
												<< ", error variable " << c.prior.error_variable;
		EXPECT_LT((J.J_node - numericalDerivative(node, 6)).norm(), 1e-7) << where;
		if (c.prior.error_variable >= 0) {
			EXPECT_LT((J.J_error - numericalDerivative(error, 6)).norm(), 1e-7) << where;
		}
		const int n = priorDimension(c.prior.kind);
		EXPECT_TRUE(J.e.tail(6 - n).isZero() && J.J_node.bottomRows(6 - n).isZero()) << where;
	}
}

TEST(PriorResidual, NormalEquationsAreTheJacobiansSquared)
{
	for (const TPriorCase& c : priorCases()) {
		const auto J = priorJacobians(c.prior, c.states);
		const auto N = linearizePrior(c.prior, c.states);
		const Matrix6d& Omega = c.prior.information;
		const Matrix6d* jacobians[] = {&J.J_node, &J.J_error};
		EXPECT_NEAR(N.s, priorMahalanobis2(c.prior, c.states), 1e-12 * (1 + N.s));
		EXPECT_EQ(N.count, c.prior.error_variable < 0 ? 1 : 2);
		for (int a = 0; a < N.count; a++) {
			EXPECT_LT((N.g[a] - jacobians[a]->transpose() * Omega * J.e).norm(), 1e-11);
			for (int b = 0; b <= a; b++) {
				const Matrix6d H = jacobians[a]->transpose() * Omega * *jacobians[b];
				EXPECT_LT((N.H[TFactorNormal::lower(a, b)] - H).norm(), 1e-11) << toString(c.prior.kind);
			}
		}
	}
}

/** R_measured = Exp(e) R, e in map axes: the residual is -e in the rows of its kind, to first order. */
TEST(PriorResidual, TurnsAreInMapAxes)
{
	std::mt19937 rng(9);
	for (int i = 0; i < 20; i++) {
		TNodeStates states{{randomPose(rng, 5, 2)}, {Vector6d::Zero()}};
		const Eigen::Vector3d e = 1e-5 * randomVector(rng, 1);
		Eigen::Isometry3d measured = states.poses[0];
		measured.linear() = expSO3(e) * measured.linear();
		const auto residual = [&](EPriorKind kind) {
			return priorResidual(priorOn(0, kind, measured, 1), states);
		};
		EXPECT_LT((residual(EPriorKind::RollPitch).head<2>() + e.head<2>()).norm(), 1e-9) << i;
		EXPECT_NEAR(residual(EPriorKind::Heading)[0], -e.z(), 1e-9) << i;
		EXPECT_LT((residual(EPriorKind::Attitude).head<3>() + e).norm(), 1e-9) << i;
	}
}

TEST(PriorResidual, RollPitchIgnoresTheHeadingAndHeadingTheTilt)
{
	std::mt19937 rng(9);
	for (int i = 0; i < 20; i++) {
		const TNodeStates states{{randomPose(rng, 5, 2)}, {Vector6d::Zero()}};
		Eigen::Isometry3d turned = states.poses[0], tilted = turned;
		turned.linear() = expSO3(Eigen::Vector3d(0, 0, 1.0 + 0.1 * i)) * turned.linear();
		tilted.linear() = expSO3(Eigen::Vector3d(0.1 * i, 0.5, 0)) * tilted.linear();
		EXPECT_LT(priorMahalanobis2(priorOn(0, EPriorKind::RollPitch, turned, 1), states), 1e-20) << i;
		EXPECT_LT(priorMahalanobis2(priorOn(0, EPriorKind::Heading, tilted, 1), states), 1e-20) << i;
		EXPECT_GT(priorMahalanobis2(priorOn(0, EPriorKind::RollPitch, tilted, 1), states), 0.1) << i;
		EXPECT_GT(priorMahalanobis2(priorOn(0, EPriorKind::Heading, turned, 1), states), 0.1) << i;
	}
}

TEST(Priors, HoldAGraphWithoutAFixedNode)
{
	const std::vector<std::vector<EPriorKind>> sets = {
		{EPriorKind::FullPose},
		{EPriorKind::Position, EPriorKind::Attitude},
		{EPriorKind::HorizontalPosition, EPriorKind::Depth, EPriorKind::RollPitch, EPriorKind::Heading},
	};
	for (size_t set = 0; set < sets.size(); set++)
		for (const std::string method : {"levenberg-marquardt", "gauss-newton"}) {
			auto planted = plantedGraph(13, 40, 40, 0.05, false);
			planted.graph.setFixed(0, false);
			int node = 3;
			for (const EPriorKind kind : sets[set]) {
				node += 5;
				planted.graph.addPrior(priorOn(node, kind, planted.truth[node], 0.1));
			}
			perturb(planted.graph, 2, 0.1);
			TOptimizerOptions options;
			options.method = method;
			CSparseOptimizer optimizer(options);
			const auto result = optimizer.optimize(planted.graph);
			EXPECT_TRUE(result.converged()) << "set " << set << ": " << toString(result.status);
			EXPECT_LT(largestDifference(planted.graph.poses(), planted.truth), 1e-6) << "set " << set;
			EXPECT_EQ(result.degrees_of_freedom, 6 * (79 - 40) + 6) << "set " << set;
			EXPECT_EQ(result.prior_weights.size(), sets[set].size());
		}
}

TEST(Priors, ThreePositionsHoldAGraph)
{
	auto planted = plantedGraph(13, 40, 40, 0.05, false);
	planted.graph.setFixed(0, false);
	for (const int node : {2, 17, 33})
		planted.graph.addPrior(priorOn(node, EPriorKind::Position, planted.truth[node], 0.01));
	perturb(planted.graph, 2, 0.1);
	EXPECT_TRUE(CSparseOptimizer().optimize(planted.graph).converged());
	EXPECT_LT(largestDifference(planted.graph.poses(), planted.truth), 1e-6);
}

TEST(Priors, WhatTheyDoNotHoldIsNamed)
{
	auto planted = plantedGraph(13, 10, 10, 0.05, true);
	auto& graph = planted.graph;
	graph.setFixed(0, false);
	const auto problem = [&] {
		CSparseOptimizer optimizer;
		return errorOf<CError>([&] { optimizer.optimize(graph); });
	};
	const auto expect = [&](const char* words) {
		const std::string message = problem();
		EXPECT_NE(message.find(words), std::string::npos) << message;
		EXPECT_NE(message.find("node 0 (edges 0"), std::string::npos) << message;
	};
	expect("no chain of edges");
	graph.addPrior(priorOn(3, EPriorKind::RollPitch, planted.truth[3], 0.1));
	expect("horizontal position");
	graph.addPrior(priorOn(4, EPriorKind::HorizontalPosition, planted.truth[4], 0.1));
	expect("depth");
	graph.addPrior(priorOn(5, EPriorKind::Depth, planted.truth[5], 0.1));
	expect("heading");
	graph.addPrior(priorOn(6, EPriorKind::Heading, planted.truth[6], 0.1));
	EXPECT_EQ(problem(), "");
}

/** Two positions and a depth count six numbers and two places, but leave the turn about their line. */
TEST(Priors, ARankDeficiencyThatOnlyTheNumbersShowIsToldWithItsNode)
{
	CPoseGraph graph;
	const auto T = Eigen::Isometry3d::Identity();
	graph.addNode(T);
	for (int i = 0; i < 3; i++)
		graph.addPrior(priorOn(0, EPriorKind::Position, T, 0.1));
	CSparseOptimizer optimizer;
	graph.setPose(0, retract(T, Vector6d::Ones()));
	const auto result = optimizer.optimize(graph);
	EXPECT_EQ(result.status, EOptimizerStatus::Singular);
	EXPECT_EQ(result.failed_node, 0);
	EXPECT_NE(result.problem.find("node 0 (no edges; priors 0, 1, 2)"), std::string::npos) << result.problem;
	EXPECT_NE(errorOf<CError>([&] { optimizer.marginals(graph); }).find("node 0 ("), std::string::npos);
}

TEST(Priors, BadOnesAreRefusedByName)
{
	const auto planted = plantedGraph(1, 5, 0, 0.1, true);
	const std::vector<std::pair<const char*, std::function<void(TPosePrior&)>>> bad = {
		{"does not exist", [](TPosePrior& p) { p.node = 9; }},
		{"does not exist", [](TPosePrior& p) { p.node = -1; }},
		{"wrong kind", [](TPosePrior& p) { p.kind = EPriorKind::ErrorVariable; }},
		{"wrong kind", [](TPosePrior& p) { p.node = 5; }},
		{"error variable", [](TPosePrior& p) { p.error_variable = 3; }},
		{"not finite", [](TPosePrior& p) { p.T_map_node.translation().x() = std::nan(""); }},
		{"not orthonormal", [](TPosePrior& p) { p.T_map_node.linear() *= 2; }},
		{"positive definite", [](TPosePrior& p) { p.information(1, 1) = 0; }},
		{"positive definite", [](TPosePrior& p) { p.information(0, 0) = std::nan(""); }},
		{"not finite", [](TPosePrior& p) { p.sensitivity(2, 5) = std::nan(""); }},
		{"scale", [](TPosePrior& p) { p.loss.scale = 0; }},
		{"weight", [](TPosePrior& p) { p.loss.weight = -1; }},
	};
	for (size_t k = 0; k < bad.size(); k++) {
		CPoseGraph graph = planted.graph;
		graph.addErrorVariable(Vector6d::Zero(), isotropic(1));	 // node 5, prior 0
		TPosePrior prior = priorOn(2, EPriorKind::Position, planted.truth[2], 0.1);
		bad[k].second(prior);
		const std::string message = errorOf<CError>([&] { graph.addPrior(prior); });
		EXPECT_NE(message.find(bad[k].first), std::string::npos) << k << ": " << message;
		EXPECT_NE(message.find("prior 1 ("), std::string::npos) << message;
		EXPECT_NE(message.find("of node " + std::to_string(prior.node)), std::string::npos) << message;
		EXPECT_EQ(graph.priorCount(), 1u);
	}
	CPoseGraph graph = planted.graph;
	TPosePrior depth = priorOn(2, EPriorKind::Depth, planted.truth[2], 0.1);
	depth.information(3, 3) = -7;  // beyond a depth's one dimension
	EXPECT_EQ(graph.addPrior(depth), 0);
	depth.node = 3;
	EXPECT_THROW(graph.setPrior(0, depth), CError);
	EXPECT_THROW(graph.addErrorVariable(Vector6d::Zero(), Matrix6d::Zero()), CError);
	EXPECT_EQ(graph.nodeCount(), 5u);
}

namespace
{
/** A closed survey whose odometry is 1 % too long, each of its edges: 0.01 at component 0 of the variable. */
struct TScaledSurvey
{
	CPoseGraph graph;
	std::vector<Eigen::Isometry3d> truth;
	int scale{-1};
};

TScaledSurvey scaledSurvey(unsigned seed, double scale_error)
{
	std::mt19937 rng(seed);
	TScaledSurvey out;
	auto T = Eigen::Isometry3d::Identity();
	const auto add = [&](int from, int to, double sigma, double stretch) {
		TPoseEdge edge;
		edge.from = from;
		edge.to = to;
		edge.information = isotropic(sigma);
		edge.T_from_to =
			retract(out.truth[from].inverse() * out.truth[to], gaussian6(rng, sigma * Vector6d::Ones()));
		const Eigen::Vector3d t = edge.T_from_to.translation();
		edge.T_from_to.translation() = (1 + stretch) * t;
		if (stretch != 0) {	 // meant: t_measured (1 - c)
			edge.error_variable = out.scale;
			edge.sensitivity = Matrix6d::Zero();
			edge.sensitivity.block<3, 1>(0, 0) = -edge.T_from_to.linear().transpose() * t;
		}
		out.graph.addEdge(edge);
	};
	for (int i = 0; i < 60; i++) {
		out.truth.push_back(T);
		out.graph.addNode(T, i == 0);
		T = T * retract(
					Eigen::Isometry3d::Identity(),
					(Vector6d() << 1, 0, 0, 0, 0, i % 15 < 2 ? M_PI / 4 : 0).finished());
	}
	out.scale = out.graph.addErrorVariable(Vector6d::Zero(), isotropic(0.05));
	for (int i = 1; i < 60; i++)
		add(i - 1, i, 2e-3, scale_error);
	for (int i = 0; i + 20 < 60; i += 6)
		add(i, i + 20, 2e-3, 0);
	return out;
}
}  // namespace

TEST(ErrorVariable, AScaleErrorIsRecoveredWithinItsSigma)
{
	double nees = 0;
	const int seeds = 30;
	for (unsigned seed = 0; seed < seeds; seed++) {
		auto survey = scaledSurvey(seed, 0.01);
		CSparseOptimizer optimizer;
		const auto result = optimizer.optimize(survey.graph);
		ASSERT_TRUE(result.converged()) << "seed=" << seed;
		EXPECT_EQ(result.degrees_of_freedom, 6 * (59 + 7 - 59)) << "the variable's prior pays for it";
		const double sigma = std::sqrt(optimizer.marginals(survey.graph).covarianceOf(survey.scale)(0, 0));
		const Vector6d c = survey.graph.errorVariable(survey.scale);
		EXPECT_LT(sigma, 1e-3);
		EXPECT_NEAR(c[0], 0.01, 4.5 * sigma) << "seed=" << seed;
		EXPECT_LT(c.tail<5>().norm(), 1e-12) << "unused components stay at the prior";
		nees += std::pow((c[0] - 0.01) / sigma, 2) / seeds;
	}
	EXPECT_NEAR(nees, 1, 4 * std::sqrt(2.0 / seeds));
}

TEST(ErrorVariable, AHeadingBiasAndAPressureOffsetAreRecovered)
{
	std::mt19937 rng(3);
	auto planted = plantedGraph(13, 40, 0, 0.01, false);
	const int bias = planted.graph.addErrorVariable(Vector6d::Zero(), isotropic(0.3));
	for (int node = 1; node < 40; node += 2) {
		TPosePrior heading = priorOn(node, EPriorKind::Heading, planted.truth[node], 0.01);
		heading.T_map_node.linear() = expSO3({0, 0, 0.1}) * heading.T_map_node.linear();
		heading.error_variable = bias;
		heading.sensitivity(0, 2) = -1;
		planted.graph.addPrior(heading);
		TPosePrior depth = priorOn(node, EPriorKind::Depth, planted.truth[node], 0.01);
		depth.T_map_node.translation().z() += 0.4;
		depth.error_variable = bias;
		depth.sensitivity(0, 1) = -1;
		planted.graph.addPrior(depth);
	}
	perturb(planted.graph, 4, 0.02);
	EXPECT_TRUE(CSparseOptimizer().optimize(planted.graph).converged());
	EXPECT_NEAR(planted.graph.errorVariable(bias)[2], 0.1, 2e-3);
	EXPECT_NEAR(planted.graph.errorVariable(bias)[1], 0.4, 2e-2);
}

TEST(ErrorVariable, AGraphThatGrowsGivesTheOptimumOfAFreshOne)
{
	auto survey = scaledSurvey(1, 0.01);
	CPoseGraph grown;
	CSparseOptimizer kept;
	for (int node = 0; node < int(survey.graph.nodeCount()); node++) {
		if (survey.graph.nodeKind(node) == ENodeKind::Pose)
			grown.addNode(survey.graph.pose(node), node == 0);
		else
			grown.addErrorVariable(Vector6d::Zero(), survey.graph.priors()[0].information);
	}
	for (int i = 1; i < 60; i++)  // a chain first: each node is held
		grown.addEdge(survey.graph.edge(i - 1));
	kept.optimize(grown);
	for (int k = 59; k < int(survey.graph.edgeCount()); k++) {
		grown.addEdge(survey.graph.edge(k));
		grown.addPrior(priorOn(k - 50, EPriorKind::Depth, survey.truth[k - 50], 0.1));
		survey.graph.addPrior(grown.priors().back());
		kept.optimize(grown);
	}
	auto fresh = grown;
	kept.optimize(grown);
	CSparseOptimizer().optimize(fresh);
	EXPECT_EQ(largestDifference(grown.poses(), fresh.poses()), 0);
	CSparseOptimizer().optimize(survey.graph);
	EXPECT_LT(largestDifference(grown.poses(), survey.graph.poses()), 1e-6);
}

TEST(ErrorVariable, G2oFilesKeepTheEdgesChi2)
{
	auto survey = scaledSurvey(1, 0.01);
	CSparseOptimizer().optimize(survey.graph);
	const std::string path = ::testing::TempDir() + "posidonia_error_variable.g2o";
	writeG2o(path, survey.graph);
	const auto back = readG2o(path);
	std::remove(path.c_str());
	EXPECT_EQ(back.graph.nodeCount(), 60u);
	const double prior = priorsMahalanobis2(survey.graph)[0];
	EXPECT_GT(prior, 1e-3);
	EXPECT_NEAR(chi2(back.graph), chi2(survey.graph) - prior, 1e-8 * chi2(back.graph));
}

TEST(ErrorVariable, SpanningTreesStartAtFullPosePriors)
{
	auto planted = plantedGraph(5, 20, 10, 0.1, false);
	planted.graph.setFixed(0, false);
	planted.graph.addErrorVariable(Vector6d::Zero(), isotropic(1));
	EXPECT_THROW(initializeFromSpanningTree(planted.graph), CError);
	planted.graph.addPrior(priorOn(7, EPriorKind::FullPose, planted.truth[7], 0.1));
	perturb(planted.graph, 1, 1.0);
	initializeFromSpanningTree(planted.graph);
	planted.truth.push_back(Eigen::Isometry3d::Identity());
	EXPECT_LT(largestDifference(planted.graph.poses(), planted.truth), 1e-9);
}
