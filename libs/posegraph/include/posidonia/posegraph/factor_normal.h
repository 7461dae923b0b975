#pragma once

#include <posidonia/posegraph/pose_graph.h>

namespace posidonia
{
/** The nodes that a factor joins. */
struct TFactorNodes
{
	int count{0};
	int node[3]{-1, -1, -1};
};

/** from, to and, if any, the error variable. */
inline TFactorNodes nodesOf(const TPoseEdge& edge)
{
	return {edge.error_variable < 0 ? 2 : 3, {edge.from, edge.to, edge.error_variable}};
}
/** The node and, if any, the error variable. */
inline TFactorNodes nodesOf(const TPosePrior& prior)
{
	return {prior.error_variable < 0 ? 1 : 2, {prior.node, prior.error_variable, -1}};
}

/** A factor's share of the normal equations, losses ignored: over its `count` nodes, blocks J_a^T Omega J_b
 * and J_a^T Omega e with respect to retractNode(). Entries beyond `count` are not set. */
struct TFactorNormal
{
	double s;  ///< e^T Omega e
	int count;
	int node[3];
	Vector6d g[3];
	Matrix6d H[6];	///< lower blocks (0,0), (1,0), (1,1), (2,0), (2,1), (2,2)

	static int lower(int a, int b) { return a * (a + 1) / 2 + b; }	///< index of block (a, b), a >= b
};

TFactorNormal linearizeEdge(const TPoseEdge& edge, const TNodeStates& states);
TFactorNormal linearizePrior(const TPosePrior& prior, const TNodeStates& states);

/** e^T Omega e alone. */
double edgeMahalanobis2(const TPoseEdge& edge, const TNodeStates& states);
double priorMahalanobis2(const TPosePrior& prior, const TNodeStates& states);
}  // namespace posidonia
