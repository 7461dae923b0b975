#pragma once

#include <posidonia/posegraph/spanning_tree.h>

#include <algorithm>

#include "random_graph.h"

namespace posidonia::testing
{
/** A spiral of `rings` x `rings` nodes over a sphere, with sphere2500's structure: odometry, and an edge from
 * each node to the one above it in the next ring. Odometry edges come first; poses start by composing them.
 */
struct TGeneratedSphere
{
	CPoseGraph graph;
	std::vector<Eigen::Isometry3d> truth;
	std::vector<char> wrong;  ///< of each edge: replaced by a random one?
};

/** Standard deviations of sphere2500's information, over (rho, phi). */
inline Vector6d sphere2500Sigmas()
{
	const double t = 1 / std::sqrt(10.0);
	return (Vector6d() << t, t, t, 0.1, 0.1, 0.2).finished();
}

inline Eigen::Isometry3d spherePose(int id, int rings, double radius)
{
	const Eigen::AngleAxisd around(-M_PI + 2 * M_PI * (id % rings) / rings, Eigen::Vector3d::UnitZ());
	const Eigen::AngleAxisd up(-M_PI / 2 + M_PI * id / (rings * rings), Eigen::Vector3d::UnitY());
	Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
	T.linear() = (around * up).toRotationMatrix();
	T.translation() = T.linear() * Eigen::Vector3d(radius, 0, 0);
	return T;
}

/** @param noise real standard deviations as a part of those that the information claims
 * @param outliers part of the loops replaced: two random nodes, with the measurement of the loop replaced, as
 * a false recognition of a place would give it */
inline TGeneratedSphere generatedSphere(unsigned seed, int rings, double noise, double outliers)
{
	std::mt19937 rng(seed);
	TGeneratedSphere out;
	const int n = rings * rings;
	const Vector6d sigmas = sphere2500Sigmas();
	for (int id = 0; id < n; id++)
		out.graph.addNode(out.truth.emplace_back(spherePose(id, rings, 50)), id == 0);
	const auto add = [&](int from, int to) {
		TPoseEdge edge;
		edge.from = from;
		edge.to = to;
		edge.T_from_to = retract(out.truth[from].inverse() * out.truth[to], gaussian6(rng, noise * sigmas));
		edge.information = sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
		out.graph.addEdge(edge);
	};
	for (int id = 1; id < n; id++)
		add(id - 1, id);
	initializeFromSpanningTree(out.graph);
	for (int id = rings; id < n; id++)
		add(id - rings, id);
	out.wrong.assign(out.graph.edgeCount(), 0);
	std::fill_n(out.wrong.begin() + (n - 1), int(outliers * (n - rings)), 1);
	std::shuffle(out.wrong.begin() + (n - 1), out.wrong.end(), rng);
	CPoseGraph spoilt;
	for (int id = 0; id < n; id++)
		spoilt.addNode(out.graph.pose(id), id == 0);
	std::uniform_int_distribution<int> any(0, n - 1);
	for (size_t k = 0; k < out.wrong.size(); k++) {
		TPoseEdge edge = out.graph.edge(int(k));
		while (out.wrong[k] && std::abs(edge.from - edge.to) <= rings) {
			edge.from = any(rng);
			edge.to = any(rng);
		}
		spoilt.addEdge(edge);
	}
	out.graph = spoilt;
	return out;
}

/** The same without the wrong edges, starting at the truth: what an oracle would optimise. */
inline CPoseGraph trueEdgesOnly(const TGeneratedSphere& sphere)
{
	CPoseGraph out;
	for (size_t id = 0; id < sphere.truth.size(); id++)
		out.addNode(sphere.truth[id], id == 0);
	for (size_t k = 0; k < sphere.wrong.size(); k++)
		if (!sphere.wrong[k]) out.addEdge(sphere.graph.edge(int(k)));
	return out;
}

inline double meanPositionError(const CPoseGraph& graph, const std::vector<Eigen::Isometry3d>& truth)
{
	double sum = 0;
	for (size_t i = 0; i < truth.size(); i++)
		sum += (graph.poses()[i].translation() - truth[i].translation()).norm();
	return sum / double(truth.size());
}
}  // namespace posidonia::testing
