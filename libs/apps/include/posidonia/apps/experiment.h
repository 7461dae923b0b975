#pragma once

#include <posidonia/apps/mission/closed_loop_options.h>
#include <posidonia/base/ini_file.h>
#include <posidonia/control/autopilot.h>
#include <posidonia/control/safe_correction.h>
#include <posidonia/eval/evaluate_run.h>
#include <posidonia/eval/loop_evaluation.h>
#include <posidonia/graphslam/slam_parts.h>
#include <posidonia/nav/ekf_options.h>
#include <posidonia/nav/nav_statistics.h>
#include <posidonia/nav/odometry_corruptor.h>
#include <posidonia/nav/recorded_odometry.h>
#include <posidonia/obs/sensor_suite.h>
#include <posidonia/sim/faults.h>
#include <posidonia/sim/simulation_options.h>

namespace posidonia
{
/** Section [Odometry]. */
struct TOdometryChoice
{
	std::string source{"ekf"};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice(
			"source", source, {"ekf", "recorded"}, "ekf: the navigation filter; recorded: poses in the log");
	}
};

/** Section [Report]. */
struct TReportOptions
{
	int paper_experiment{0};
	bool page{true}, pictures{true};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.integer(
			"paper_experiment", paper_experiment, between(0, 2),
			"Print the paper's table of experiment 1 or 2; 0: none");
		v.flag("page", page, "End a run with its report.html");
		v.flag("pictures", pictures, "Keep the left picture of each node, for the report (loops/, JPEG)");
	}
};

/** Everything an ini may say: one file drives all apps, each takes what it needs, and a key that no app knows
 * is an error in every one of them. */
struct TExperiment
{
	TSimulationOptions simulation;
	TEkfOptions ekf;
	TDragOptions drag;
	TInitialPoseOptions initial_pose;
	TOdometryChoice odometry;
	TRecordedOdometryOptions recorded;
	TOdometryCorruptionOptions corruption;
	TStereoSlamOptions slam;
	TEvaluationOptions evaluation;
	TLoopEvaluationOptions loop_evaluation;
	TReportOptions report;
	TClosedLoopOptions closed_loop;
	TSlamLatencyOptions latency;
	TForcedCorrectionOptions forced_correction;
	TControllerPoseOptions controller_pose;
	TAutopilotOptions autopilot;
	std::vector<TFaultOptions> faults;

	/** Loads every section and overrides `sensors` by the sections [Sensor.<label>]. Throws CError. */
	static TExperiment load(CIniFile& ini, TSensorSuite& sensors);

	/** The odometry that the ini asks for, as it is. */
	std::unique_ptr<COdometrySource> makeCleanOdometry(const TSensorSuite& sensors) const;
	/** The same behind the paper's drift corruptor (which does nothing when its drifts are 0). */
	std::unique_ptr<COdometrySource> makeOdometry(const TSensorSuite& sensors) const;
};

/** Pose of the navigation filter (or recording) behind a corruptor, at the present. */
Eigen::Isometry3d uncorruptedPose(const COdometrySource& odometry);
/** Counts by sensor of the navigation filter behind a corruptor; empty for a recording. */
std::map<std::string, TSensorCount> navigationCounts(const COdometrySource& odometry);
/** Statistics of the navigation filter behind a corruptor; empty for a recording. */
std::string navigationText(const COdometrySource& odometry);

/** Sensors of a rawlog: <name>.sensors.ini beside it; SPARUS II's with `assume_defaults` when it is absent.
 */
TSensorSuite sensorsOfRawlog(const std::string& rawlog, bool assume_defaults);
}  // namespace posidonia
