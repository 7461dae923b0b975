#pragma once

#include <posidonia/apps/interrupt.h>
#include <posidonia/apps/replay_command.h>
#include <posidonia/apps/report_files.h>
#include <posidonia/apps/run_folder.h>
#include <posidonia/nav/ekf_odometry.h>
#include <posidonia/obs/rawlog_reader.h>
#include <posidonia/obs/rawlog_writer.h>

#include <memory>

namespace posidonia
{
/** auv-ekf: the navigation filter over a rawlog, without graph and without the drift corruptor. Writes
 * ekf.tum and a rawlog with the filter's poses among the observations, which replays with [Odometry] source =
 * recorded. */
class CEkfApp
{
   public:
	static constexpr const char* name = "auv-ekf";
	/** sensorLabel of the poses in the new rawlog. */
	static constexpr const char* pose_label = "EKF";

	/** False when --help, --version or --dump-config was answered. Throws CError, CUsageError. */
	bool initialize(int argc, const char* const* argv);
	void run();

	/** What came out, in memory; the run folder holds the same. */
	struct TResults
	{
		TTrajectory ekf;	   ///< T_odom_body
		TTrajectory smoothed;  ///< With --smooth
		TPoseEstimate last;	   ///< With the way since the start
		size_t observations{0};
		TMetrics metrics;
		std::string folder, rawlog;
		bool interrupted{false};  ///< The run is not, its folder is whole
	};
	const TResults& results() const { return m_results; }
	int exitStatus() const { return m_results.interrupted ? CInterrupt::kStatus : 0; }
	TExperiment params;

   private:
	void replay(
		COdometrySource& odometry, CRawlogReader& reader, CRawlogWriter& writer, const CInterrupt& interrupt);
	/** Is it time for the next pose? */
	bool isDue(const COdometrySource& odometry) const;
	void writePose(const COdometrySource& odometry, CRawlogWriter& writer);
	void linkImages();
	void writeReportFiles(const COdometrySource& odometry);
	/** Rows "navigation....": way, duration, sigmas of the last pose. */
	void summarize(const TPoseEstimate& last);
	void score();
	/** smoothed.tum: the filter's way back over the readings. */
	void smooth(const CEkfOdometry& odometry);
	void logSummary(const COdometrySource& odometry, const CRawlogReader& reader, double seconds);

	TReplayInput m_input;
	double m_rate{10};	///< [Hz]
	bool m_smooth{false}, m_json{false};
	std::vector<TSensorReading> m_readings;	 ///< For smoothing
	std::unique_ptr<CRunFolder> m_folder;
	bool m_has_pictures{false};	 ///< Does any observation refer to a picture file?
	TResults m_results;
};
}  // namespace posidonia
