#pragma once

#include <posidonia/graphslam/stereo_slam.h>
#include <posidonia/nav/odometry_corruptor.h>
#include <posidonia/sim/survey_simulator.h>

#include <memory>
#include <string>
#include <vector>

/** A small simulated survey that all tests of the engine share, and ways to run the engine on it. */
namespace posidonia::testing
{
/** A square of 3 m, flown 1.3 times, 2.5 m above rock, 320x240 px; the log of it, read back from its files.
 */
struct TSurvey
{
	std::string rawlog;
	TSimulationOptions simulation;
	TSensorSuite sensors;
	std::vector<mrpt::obs::CObservation::Ptr> observations;	 ///< As read from the rawlog
	std::vector<double> pair_stamps;

	Eigen::Isometry3d truth(double stamp) const;
	std::unique_ptr<COdometrySource> ekf() const;
};

/** Simulated at the first call, in a folder that is removed at the program's end. */
const TSurvey& survey();

/** How the engine is to be run on the survey. */
struct TSetup
{
	TStereoSlamOptions slam;
	TOdometryCorruptionOptions corruption;
	std::string config_file;
	int stop_at_nodes{1000};
	TSetup() { slam.features.max_features = 400; }
};
/** The paper's second experiment: 12 mm/m in north and east, 4 mm/m in down. */
TSetup secondExperiment();

std::unique_ptr<CStereoSlam> run(const TSetup& setup);
/** The engine with all defaults on secondExperiment(); made once. */
const CStereoSlam& defaultRun();

/** Mean distance [m] to the truth of the nodes as optimised, and as the odometry had them. */
double meanNodeError(const CStereoSlam& slam);
double meanOdometryError(const CStereoSlam& slam);

/** How far T_i_j of nodes i, j is from the truth. */
struct TPairError
{
	double metres, radians;
	/** The project's limits for a false edge: 0.3 m, 5 degrees. */
	bool isFalse() const { return metres > 0.3 || radians > 5 * M_PI / 180; }
};
TPairError errorOfPair(const CStereoSlam& slam, int i, int j, const Eigen::Isometry3d& T_i_j);

int edgesOf(const CStereoSlam& slam, EEdgeKind kind);

/** All node poses, causal poses and candidates, byte by byte. */
std::string fingerprint(const CStereoSlam& slam);
}  // namespace posidonia::testing
