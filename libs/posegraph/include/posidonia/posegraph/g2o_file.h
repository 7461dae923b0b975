#pragma once

#include <posidonia/posegraph/pose_graph.h>

#include <string>

namespace posidonia
{
/** A graph of a g2o file; `file_ids[node]` is the node's id there, ascending. */
struct TG2oGraph
{
	CPoseGraph graph;
	std::vector<long long> file_ids;
};

/** Reads VERTEX_SE3:QUAT, EDGE_SE3:QUAT and FIX, in any order, any ids. Edges keep the file's order and get
 * no robust loss (the format has none). Without FIX the lowest id is held fixed. The file's information is
 * over (t, vec q) and becomes the one over (rho, phi) (README, "Information"). Throws CError "<file>:<line>:
 * ...". */
TG2oGraph readG2o(const std::string& path);

/** Writes poses, FIX and edges with 17 significant digits, whole or not at all. The format has neither priors
 * nor error variables nor losses: these are left out, and an edge with an error variable is written with its
 * corrected measurement, so that the edges' chi2 is the graph's. A graph that priors alone hold gets no FIX.
 * @param file_ids id of each node; empty: the graph's own. Throws CError when there are too few or repeated
 * ids. */
void writeG2o(const std::string& path, const CPoseGraph& graph, const std::vector<long long>& file_ids = {});
}  // namespace posidonia
