#pragma once

#include <posidonia/posegraph/pose_graph.h>

namespace posidonia
{
/** Poses from the edges alone, whatever they were before: rotations by linear least squares on their nine
 * numbers, projected to SO(3), then translations by a linear solve (Carlone, Tron, Daniilidis, Dellaert 2015,
 * sec. III-D; Martinec, Pajdla 2007). Anchors are the fixed nodes and those with a full-pose prior, which are
 * put there; other priors and losses are ignored but for the losses' weights, error variables are left.
 * Throws CError naming a node that no chain of edges joins to an anchor (the graph is left as it was). */
void initializeChordal(CPoseGraph& graph);
}  // namespace posidonia
