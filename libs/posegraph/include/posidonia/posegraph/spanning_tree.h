#pragma once

#include <posidonia/posegraph/pose_graph.h>

namespace posidonia
{
/** Poses by composing edges along a breadth-first tree from the fixed nodes and those with a full-pose prior,
 * ties to the lower edge index; every free pose is replaced, error variables are left. Throws CError naming a
 * node that is not reached (the graph is left as it was). */
void initializeFromSpanningTree(CPoseGraph& graph);

/** The same along the edges of these indices only, e.g. the odometry's. */
void initializeFromSpanningTree(CPoseGraph& graph, const std::vector<int>& edge_indices);
}  // namespace posidonia
