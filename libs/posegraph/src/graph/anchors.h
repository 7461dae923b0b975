#pragma once

#include <posidonia/posegraph/pose_graph.h>

namespace posidonia
{
/** The nodes whose pose is known beforehand: fixed ones, and those with a full-pose prior, put there. */
std::vector<char> anchors(const CPoseGraph& graph, std::vector<Eigen::Isometry3d>& poses);

/** Throws CError naming a pose that is not reached. */
void requireReached(const CPoseGraph& graph, const std::vector<char>& reached);

/** An edge's measurement at the graph's error variables. */
Eigen::Isometry3d presentMeasurement(const CPoseGraph& graph, const TPoseEdge& edge);
}  // namespace posidonia
