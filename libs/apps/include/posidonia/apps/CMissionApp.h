#pragma once

#include <posidonia/apps/command_line.h>
#include <posidonia/apps/experiment.h>
#include <posidonia/apps/interrupt.h>
#include <posidonia/apps/mission/mission_score.h>
#include <posidonia/apps/report_files.h>
#include <posidonia/apps/slam_outputs.h>

#include <memory>

namespace posidonia
{
/** auv-mission: a mission in closed loop: simulator, odometry, SLAM, guidance, control and safety as one. */
class CMissionApp
{
   public:
	static constexpr const char* name = "auv-mission";

	/** False when --help, --version or --dump-config was answered. Throws CError, CUsageError. */
	bool initialize(int argc, const char* const* argv);
	void run();

	/** What came out, in memory; the run folder holds the same. */
	struct TResults
	{
		std::vector<TControlStep> steps;
		TRunTrajectories trajectories;
		TSlamCounts counts;
		TMetrics metrics;
		std::string folder, rawlog;
		double seconds{0};		  ///< Of the clock
		int missed_deadlines{0};  ///< With --realtime
		std::string aborted;	  ///< Why the mission was not done; empty when it was
		bool interrupted{false};  ///< The mission is not done, the run folder is whole
	};
	const TResults& results() const { return m_results; }
	/** A mission that was aborted is not done: 1. */
	int exitStatus() const
	{
		return m_results.interrupted ? CInterrupt::kStatus : m_results.aborted.empty() ? 0 : 1;
	}
	TExperiment params;

   private:
	struct TLoop;
	void loadMissionFile(const std::string& path);
	void fly(TLoop& loop, const CInterrupt& interrupt);
	void writeResults(TLoop& loop);
	void writeWorldFiles(const TLoop& loop) const;
	void score();
	void logSummary(TLoop& loop);
	void writeReportFiles(TLoop& loop);

	TSensorSuite m_sensors;
	TMission m_mission;
	std::string m_config, m_mission_text, m_title;
	std::unique_ptr<CRunFolder> m_folder;
	int m_verbosity{1};
	bool m_realtime{false}, m_json{false};
	TResults m_results;
};
}  // namespace posidonia
