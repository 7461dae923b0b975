#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/edge_residual.h>

namespace posidonia
{
TChi2 chi2At(const CPoseGraph& graph, const std::vector<Eigen::Isometry3d>& poses)
{
	TChi2 sum;
	for (const TPoseEdge& edge : graph.edges()) {
		const double s = edgeMahalanobis2(edge, poses[edge.from], poses[edge.to]);
		sum.plain += s;
		sum.robust += robustCost(edge.loss, s);
	}
	return sum;
}

double chi2(const CPoseGraph& graph)
{
	return chi2At(graph, graph.poses()).plain;
}

std::vector<double> edgesMahalanobis2(const CPoseGraph& graph)
{
	std::vector<double> out;
	out.reserve(graph.edgeCount());
	for (const TPoseEdge& edge : graph.edges())
		out.push_back(edgeMahalanobis2(edge, graph.poses()[edge.from], graph.poses()[edge.to]));
	return out;
}
}  // namespace posidonia
