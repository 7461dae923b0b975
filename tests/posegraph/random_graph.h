#pragma once

#include <posidonia/posegraph/pose_graph.h>
#include <random_pose.h>

namespace posidonia::testing
{
/** A planted trajectory, and a graph of measurements of it that starts at the truth. */
struct TPlantedGraph
{
	CPoseGraph graph;
	std::vector<Eigen::Isometry3d> truth;
};

inline Vector6d gaussian6(std::mt19937& rng, const Vector6d& sigmas)
{
	std::normal_distribution<double> n;
	Vector6d d;
	for (int i = 0; i < 6; i++)
		d[i] = sigmas[i] * n(rng);
	return d;
}

/** Covariance A A^T with a full, random A of the size of `sigma`, and a sample of it. */
inline TPoseEdge measure(
	std::mt19937& rng, const std::vector<Eigen::Isometry3d>& truth, int from, int to, double sigma,
	bool noisy)
{
	const Matrix6d cov = randomCovariance(rng, sigma);
	TPoseEdge edge;
	edge.from = from;
	edge.to = to;
	edge.information = cov.inverse();
	edge.information = (0.5 * (edge.information + edge.information.transpose())).eval();
	const Vector6d d = Eigen::LLT<Matrix6d>(cov).matrixL() * gaussian6(rng, Vector6d::Ones());
	edge.T_from_to = retract(truth[from].inverse() * truth[to], noisy ? d : Vector6d(0 * d));
	return edge;
}

/** A chain of `n` random poses, node 0 fixed, with `extra` random chords in either direction. */
inline TPlantedGraph plantedGraph(unsigned seed, int n, int extra, double sigma, bool noisy)
{
	std::mt19937 rng(seed);
	TPlantedGraph out;
	for (int i = 0; i < n; i++) {
		const auto step = randomPose(rng, 1.0, 1.0);
		out.truth.push_back(i == 0 ? step : out.truth.back() * step);
		out.graph.addNode(out.truth.back(), i == 0);
	}
	for (int i = 1; i < n; i++)
		out.graph.addEdge(measure(rng, out.truth, i - 1, i, sigma, noisy));
	std::uniform_int_distribution<int> any(0, n - 1);
	for (int k = 0; k < extra;) {
		const int a = any(rng), b = any(rng);
		if (a == b) continue;
		out.graph.addEdge(measure(rng, out.truth, a, b, sigma, noisy));
		k++;
	}
	return out;
}

/** A prior that says that the node is at T, isotropic [m, rad]. */
inline TPosePrior priorOn(int node, EPriorKind kind, const Eigen::Isometry3d& T, double sigma)
{
	TPosePrior prior;
	prior.node = node;
	prior.kind = kind;
	prior.T_map_node = T;
	prior.information = Matrix6d::Identity() / (sigma * sigma);
	return prior;
}

/** Moves every free node by Gaussian noise of `sigma` [m, rad]. */
inline void perturb(CPoseGraph& graph, unsigned seed, double sigma)
{
	std::mt19937 rng(seed);
	for (int i = 0; i < int(graph.nodeCount()); i++)
		if (!graph.isFixed(i) && graph.nodeKind(i) == ENodeKind::Pose)
			graph.setPose(i, retract(graph.pose(i), gaussian6(rng, sigma * Vector6d::Ones())));
}

/** Largest coordinate between two sets of poses [m, rad]. */
inline double largestDifference(
	const std::vector<Eigen::Isometry3d>& a, const std::vector<Eigen::Isometry3d>& b)
{
	double worst = 0;
	for (size_t i = 0; i < a.size(); i++)
		worst = std::max(worst, localCoordinates(a[i], b[i]).lpNorm<Eigen::Infinity>());
	return worst;
}
}  // namespace posidonia::testing
