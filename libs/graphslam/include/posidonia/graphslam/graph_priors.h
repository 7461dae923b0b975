#pragma once

#include <posidonia/graphslam/slam_map.h>
#include <posidonia/graphslam/slam_options.h>
#include <posidonia/posegraph/pose_graph.h>

namespace posidonia
{
/** The map as a pose graph, or what it has more than one: nodes at their present poses, the root fixed or
 * held by its prior, edges with their shares and losses, priors of what was measured absolutely (README,
 * "Priors").
 * @return is a stereo edge among what was new? */
bool appendToGraph(
	CPoseGraph& graph, const CSlamMap& map, const TGraphLossOptions& loss, const TPriorOptions& priors);

/** Loss of a stereo edge that shares nothing, with its honestFactor(). */
TRobustLoss stereoLoss(const TGraphLossOptions& options);

/** An edge of the map, as the graph sees it. @param loss stereoLoss() */
TPoseEdge toPoseEdge(const TSlamEdge& edge, const TRobustLoss& loss);

/** Variance of one of many readings, `interval` seconds apart, whose errors are white but for a part with
 * standard deviation `lasting` and correlation time `time`: as if that part, too, were white, with the same
 * spectral density at low frequency, so that the mean of many is as uncertain as it is. */
double varianceAmongMany(double sigma, double lasting, double time, double interval);
}  // namespace posidonia
