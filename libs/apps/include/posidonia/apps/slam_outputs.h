#pragma once

#include <posidonia/apps/run_folder.h>
#include <posidonia/apps/scoring.h>
#include <posidonia/graphslam/stereo_slam.h>

namespace posidonia
{
/** What SLAM made of its observations, in numbers. */
struct TSlamCounts
{
	int nodes{0}, sequential_edges{0}, roi_edges{0};
	double chi2{0}, dijkstra_chi2{0};

	/** Rows "graph.*". */
	TMetrics metrics() const;
	std::string text() const;
};
TSlamCounts countsOf(const CStereoSlam& slam);

/** Call after each observation: keeps what is handed out at the stereo pairs. */
void rememberCausal(const CStereoSlam& slam, TRunTrajectories& trajectories);

/** ekf.tum, odom.tum, slam.tum, nodes.tum, graph.g2o, loops.csv, timings.csv. */
void writeSlamFiles(const CRunFolder& folder, const CStereoSlam& slam, const TRunTrajectories& trajectories);

/** Keeps MRPT's timer from printing its table when it dies, in an error too: the times are in timings.csv. */
struct TSilencedAtEnd
{
	mrpt::system::CTimeLogger& timer;
	~TSilencedAtEnd() { timer.disable(); }
};
}  // namespace posidonia
