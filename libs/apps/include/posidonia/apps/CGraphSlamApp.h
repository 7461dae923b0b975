#pragma once

#include <posidonia/apps/interrupt.h>
#include <posidonia/apps/replay_command.h>
#include <posidonia/apps/report_files.h>
#include <posidonia/apps/run_folder.h>
#include <posidonia/apps/run_texts.h>
#include <posidonia/apps/slam_outputs.h>
#include <posidonia/obs/rawlog_reader.h>

#include <memory>

namespace posidonia
{
/** auv-graphslam: a rawlog in, a run folder with the corrected trajectory out. */
class CGraphSlamApp
{
   public:
	static constexpr const char* name = "auv-graphslam";

	/** False when --help, --version, --dump-config or --list-deciders was answered. Throws CError,
	 * CUsageError. */
	bool initialize(int argc, const char* const* argv);
	void run();

	/** What came out, in memory; the run folder holds the same. */
	struct TResults
	{
		TRunTrajectories trajectories;
		TSlamCounts counts;
		TMetrics metrics;
		std::string folder;
		bool interrupted{false};  ///< The run is not, its folder is whole
	};
	const TResults& results() const { return m_results; }
	int exitStatus() const { return m_results.interrupted ? CInterrupt::kStatus : 0; }
	TExperiment params;

   private:
	void replay(
		CStereoSlam& slam, CRawlogReader& reader, CNodePictures& pictures, const CInterrupt& interrupt);
	void writeReportFiles(const CStereoSlam& slam, CNodePictures& pictures);
	void collect(const CStereoSlam& slam, const CRawlogReader& reader);
	void score(const CStereoSlam& slam);
	void logSummary(const CStereoSlam& slam, const CRawlogReader& reader, double seconds);

	TReplayInput m_input;
	bool m_json{false};
	std::unique_ptr<CRunFolder> m_folder;
	TResults m_results;
};
}  // namespace posidonia
