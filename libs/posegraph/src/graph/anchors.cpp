#include "graph/anchors.h"

#include <posidonia/base/error.h>

namespace posidonia
{
std::vector<char> anchors(const CPoseGraph& graph, std::vector<Eigen::Isometry3d>& poses)
{
	std::vector<char> anchored(graph.nodeCount(), 0);
	for (const TPosePrior& prior : graph.priors()) {
		if (prior.kind != EPriorKind::FullPose || graph.isFixed(prior.node) || anchored[prior.node]) continue;
		poses[prior.node] = prior.T_map_node;
		anchored[prior.node] = 1;
	}
	for (int node = 0; node < int(graph.nodeCount()); node++)
		anchored[node] |= graph.isFixed(node);
	return anchored;
}

void requireReached(const CPoseGraph& graph, const std::vector<char>& reached)
{
	for (int node = 0; node < int(graph.nodeCount()); node++)
		if (!reached[node] && graph.nodeKind(node) == ENodeKind::Pose)
			throw CError(
				"node " + std::to_string(node),
				"no chain of the given edges joins it to a fixed node or full-pose prior",
				"fix a node of its component or add the missing edge");
}

Eigen::Isometry3d presentMeasurement(const CPoseGraph& graph, const TPoseEdge& edge)
{
	return edge.error_variable < 0 ? edge.T_from_to
								   : correctedMeasurement(edge, graph.errorVariable(edge.error_variable));
}
}  // namespace posidonia
