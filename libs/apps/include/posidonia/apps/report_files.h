#pragma once

#include <posidonia/apps/experiment.h>
#include <posidonia/apps/run_folder.h>
#include <posidonia/graphslam/stereo_slam.h>
#include <posidonia/report/run_files.h>

#include <future>
#include <vector>

namespace posidonia
{
/** Keeps the left picture of each node, as it is made: RUN/loops/000012.jpg. Written on another thread. */
class CNodePictures
{
   public:
	/** @param wanted else add() does nothing */
	CNodePictures(const CRunFolder& folder, bool wanted);
	~CNodePictures();

	/** Call after each observation: takes the picture of the node that it made, if it made one. */
	void add(const CStereoSlam& slam);
	/** Files of the folder, by node; empty where there is none. Waits for the last one. */
	const std::vector<std::string>& files();

   private:
	std::string m_folder;
	bool m_wanted;
	std::vector<std::string> m_files;
	std::future<void> m_writing;
};

/** poses.csv, matches.csv: what a report needs of the map beside loops.csv and graph.g2o. */
void writeMapFiles(
	const CRunFolder& folder, const CStereoSlam& slam, const std::vector<std::string>& pictures);
/** sensors.csv: the odometry's counts of each sensor, and the pairs that SLAM saw. @param duration [s] */
void writeSensorCounts(const CRunFolder& folder, const COdometrySource& odometry, double duration);
/** run.json. */
void writeRunInfo(const CRunFolder& folder, const TRunInfo& info);
/** truth.tum: the truth of the run's time. Returns its name; empty where there is none. */
std::string copyTruth(const CRunFolder& folder, const std::string& truth_file, double start, double end);

/** The last file of a run: report.html, where [Report] wants it. */
void finishReport(CRunFolder& folder, const TReportOptions& options, int verbosity);
}  // namespace posidonia
