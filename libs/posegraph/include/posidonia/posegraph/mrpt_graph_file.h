#pragma once

#include <posidonia/posegraph/pose_graph.h>

#include <string>
#include <vector>

namespace posidonia
{
/** A graph of MRPT's text format; `file_ids[node]` is the node's id there, ascending. */
struct TMrptGraphFile
{
	CPoseGraph graph;
	std::vector<long long> file_ids;
	/** Edges without a matrix in the file: they have the identity, as MRPT's own reader gives them. */
	int edges_without_information{0};
};

/** Reads what mrpt::graphs::CNetworkOfPoses3DInf::saveToTextFile() writes (usually `.graph`; TORO's format):
 *
 *   VERTEX3 id x y z roll pitch yaw
 *   FIX id
 *   EDGE3 from to x y z roll pitch yaw and the 21 upper entries of the information, row by row
 *   EQUIV a b                          (a and b are one node, which keeps the lower id)
 *
 * The file's information is over (x, y, z, roll, pitch, yaw), the translation in `from`'s axes, and becomes
 * the one over (rho, phi) in `to`'s own: J^T Omega J with J of geometry/mrpt_pose.h, exact at the edge's
 * pose. The format knows one FIX, the root; without it the lowest id is held fixed. Angles and matrices have
 * 6 digits when MRPT wrote them. Throws CError "<file>:<line>: ...", for 2D graphs too. */
TMrptGraphFile readMrptGraph(const std::string& path);
}  // namespace posidonia
