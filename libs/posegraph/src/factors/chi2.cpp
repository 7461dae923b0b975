#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/factor_normal.h>

namespace posidonia
{
TChi2 chi2At(const CPoseGraph& graph, const TNodeStates& states)
{
	TChi2 sum;
	const auto add = [&sum](const TRobustLoss& loss, double s) {
		sum.plain += s;
		sum.robust += robustCost(loss, s);
	};
	for (const TPoseEdge& edge : graph.edges())
		add(edge.loss, edgeMahalanobis2(edge, states));
	for (const TPosePrior& prior : graph.priors())
		add(prior.loss, priorMahalanobis2(prior, states));
	return sum;
}

double chi2(const CPoseGraph& graph)
{
	return chi2At(graph, graph.states()).plain;
}

std::vector<double> edgesMahalanobis2(const CPoseGraph& graph)
{
	std::vector<double> out;
	out.reserve(graph.edgeCount());
	for (const TPoseEdge& edge : graph.edges())
		out.push_back(edgeMahalanobis2(edge, graph.states()));
	return out;
}

std::vector<double> priorsMahalanobis2(const CPoseGraph& graph)
{
	std::vector<double> out;
	out.reserve(graph.priorCount());
	for (const TPosePrior& prior : graph.priors())
		out.push_back(priorMahalanobis2(prior, graph.states()));
	return out;
}
}  // namespace posidonia
