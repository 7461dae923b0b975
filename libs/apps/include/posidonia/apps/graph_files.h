#pragma once

#include <posidonia/posegraph/pose_graph.h>

#include <string>
#include <vector>

namespace posidonia
{
/** A pose graph as auv-graph-optimize reads it; `file_ids[node]` is the node's id there, ascending. */
struct TGraphFile
{
	CPoseGraph graph;
	std::vector<long long> file_ids;
	std::vector<std::string> warnings;
};

/** Reads `.graph` (MRPT's text format) or any other name as g2o. Throws CError. */
TGraphFile readGraphFile(const std::string& path);

/** edge,from,to,weight,chi2: of every edge in the file's order, with the file's ids; chi2 is the squared
 * Mahalanobis distance at the graph's poses, weight that of the robust loss (1 without one). */
void writeEdgeWeights(
	const std::string& path, const TGraphFile& file, const std::vector<double>& edge_weights);

/** Of every free node: its id, the 21 entries of the lower triangle (row by row) of the covariance of (rho
 * [m], phi [rad]) in the node's own frame, and the sigmas of its position along the map's axes [m].
 * @param covariances of each node; those of fixed nodes are not looked at */
void writeMarginals(
	const std::string& path, const TGraphFile& file, const std::vector<Matrix6d>& covariances);
}  // namespace posidonia
