#pragma once

#include <posidonia/graphslam/stereo_slam.h>
#include <posidonia/nav/ekf_odometry.h>
#include <posidonia/sim/survey_simulator.h>

#include <memory>
#include <vector>

/** A small survey whose every error is drawn from what the estimator is told of it: what covariances are
 * measured on. */
namespace posidonia::testing
{
struct THonestySurvey
{
	TSimulationOptions simulation;
	TSensorSuite sensors{TSensorSuite::sparus2()};
	TEkfOptions ekf;
	TInitialPoseOptions start;
};
/** Four tracks of 5 m, 1.5 m apart, and a diagonal back across them, 2.5 m above the floor, 640x480 px: about
 * 60 nodes. SPARUS II's sensors with the paper's AHRS of simulator grade; a known start with its error drawn;
 * biases and the DVL's scale drawn. No GPS, no corruptor, no calibration error.
 * @param photo picture of a floor for even seeds; odd seeds, or all if it is empty, fly over rock */
THonestySurvey honestySurvey(unsigned seed, const std::string& photo);

/** What came out of one survey. */
struct THonestyRun
{
	std::unique_ptr<CStereoSlam> slam;
	std::vector<Eigen::Isometry3d> T_map_body;	///< True, of each node
};
/** Without files; pictures are rendered in memory. */
THonestyRun runHonestySurvey(const THonestySurvey& survey, const TStereoSlamOptions& options);
}  // namespace posidonia::testing
