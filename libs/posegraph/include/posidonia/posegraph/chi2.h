#pragma once

#include <posidonia/posegraph/pose_graph.h>

namespace posidonia
{
/** A graph's cost, without and with the robust losses. */
struct TChi2
{
	double plain{0};   ///< sum of s_k = e_k^T Omega_k e_k; equals g2o's chi2
	double robust{0};  ///< sum of rho_k(s_k)
};

/** Costs at other poses than the graph's own. @param poses T_map_node of every node */
TChi2 chi2At(const CPoseGraph& graph, const std::vector<Eigen::Isometry3d>& poses);

/** Sum of the squared Mahalanobis distances of all edges, losses ignored. */
double chi2(const CPoseGraph& graph);

/** Squared Mahalanobis distance of each edge. */
std::vector<double> edgesMahalanobis2(const CPoseGraph& graph);
}  // namespace posidonia
