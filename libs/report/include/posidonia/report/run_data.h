#pragma once

#include <posidonia/eval/loops_file.h>
#include <posidonia/eval/metrics.h>
#include <posidonia/geometry/stereo_camera.h>
#include <posidonia/geometry/trajectory.h>
#include <posidonia/report/run_files.h>

#include <optional>

namespace posidonia
{
/** A run folder in memory. */
struct TRunData
{
	std::string folder;
	TRunInfo info;
	/** By the name of their files: truth, odom, ekf, slam, nodes, control; only those that are there. */
	std::map<std::string, TTrajectory> trajectories;
	std::vector<TNodeRow> nodes;
	std::vector<TLoopRow> loops;
	std::map<std::pair<int, int>, TMatchesRow> matches;	 ///< By (from, to)
	TMetrics metrics;
	std::map<std::string, std::vector<TTimingRow>> timings;	 ///< By group: "SLAM", "closed loop"
	std::vector<TSensorRow> sensors;
	std::vector<TEventRow> events;
	std::optional<TNumberTable> control;
	struct TCamera
	{
		TStereoCamera camera;
		Eigen::Isometry3d T_body_camera;
	};
	std::optional<TCamera> camera;
	int paper_experiment{0};
	std::string config, mission, log;

	/** That trajectory; empty when it is not there. */
	const TTrajectory& trajectory(const std::string& name) const;
	bool hasTruth() const { return !trajectory("truth").empty(); }
	std::string file(const std::string& name) const { return folder + "/" + name; }
};

/** Reads the folder of a run of auv-graphslam, auv-mission or auv-ekf. Throws CError naming the file when it
 * is no run folder (it has no run.json) or a file of it is damaged. */
TRunData readRun(const std::string& folder);
}  // namespace posidonia
