#pragma once

#include <posidonia/posegraph/pose_graph.h>

namespace posidonia
{
struct TLevMarqResult
{
	int iterations{0};
	bool stopped{false};  ///< By its own criteria, not at max_iterations. MRPT does not say by which
};

/** Optimises the graph by MRPT's mrpt::graphslam::optimize_graph_spa_levmarq, for comparison: it knows no
 * robust losses (these are ignored), and accepts steps without regard to the information, so that chi2 may
 * rise. */
TLevMarqResult optimizeWithLevMarq(CPoseGraph& graph, int max_iterations);
}  // namespace posidonia
