#pragma once

#include <posidonia/posegraph/pose_graph.h>

namespace posidonia
{
/** Edges that a neighbour confirms: of the `open` edges, those whose cycle through another open edge and at
 * most `window` trusted edges at either end closes within the chi-square `threshold2` for more neighbours
 * than it fails for (pairwise consistency: Mangelson, Dominic, Eustice, Vasudevan 2018, here over short ways
 * only, where it is sharp). Trusted edges take part where they join consecutive nodes. */
std::vector<int> supportedEdges(
	const CPoseGraph& graph, const std::vector<int>& trusted, const std::vector<int>& open, double threshold2,
	int window = 5);
}  // namespace posidonia
