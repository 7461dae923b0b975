#pragma once

#include <posidonia/posegraph/pose_graph.h>

namespace posidonia
{
/** A graph's cost over all factors, edges and priors, without and with the robust losses. */
struct TChi2
{
	double plain{0};   ///< sum of s_k = e_k^T Omega_k e_k; equals g2o's chi2 when there are edges only
	double robust{0};  ///< sum of rho_k(s_k)
};

/** Costs at other states than the graph's own. @param states of every node */
TChi2 chi2At(const CPoseGraph& graph, const TNodeStates& states);

/** Sum of the squared Mahalanobis distances of all factors, losses and weights ignored. */
double chi2(const CPoseGraph& graph);

/** Squared Mahalanobis distance of each edge. */
std::vector<double> edgesMahalanobis2(const CPoseGraph& graph);
/** Squared Mahalanobis distance of each prior. */
std::vector<double> priorsMahalanobis2(const CPoseGraph& graph);
}  // namespace posidonia
