#pragma once

#include <posidonia/dataset/attitude_errors.h>
#include <posidonia/dataset/bad_rows.h>
#include <posidonia/geometry/stereo_camera.h>
#include <posidonia/obs/geodesy.h>

#include <Eigen/Dense>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace posidonia
{
/** What a folder holds. */
enum class EDatasetFormat
{
	EUROC,		///< mav0/ in EuRoC's (ASL) layout, with an AUV's sensors
	DVL_GT_CSV	///< DVL.csv and GT.csv: velocities, and post-processed position, velocity and attitude
};

struct TDatasetOptions
{
	EDatasetFormat format{EDatasetFormat::EUROC};
	std::string input;	   ///< EUROC: the folder that holds mav0/, or mav0 itself; else that of the tables
	std::string output;	   ///< NAME.rawlog; NAME_Images/, NAME.gt.tum and NAME.sensors.ini appear beside it
	bool skip_bad{false};  ///< Bad rows and images are left out and counted instead of being an error
	bool level{
		false};	 ///< EUROC: estimate roll and pitch of the body's axes from the first second of imu0, at rest
	bool cubic{false};		///< EUROC: rectify with cubic instead of linear interpolation
	bool overwrite{false};	///< Replace the files of an earlier import
	/** The datum of the run's ini, used where body.yaml has none; none: the first fix, with a warning
	 * (EUROC), or the first row of GT.csv. */
	std::optional<TWorldOptions> datum;
	TAttitudeErrors attitude_errors;  ///< DVL_GT_CSV: put on the AHRS, not on the ground truth
};

/** What was found, what was written and what to look at. */
struct TDatasetReport
{
	std::map<std::string, size_t> observations;	 ///< Written, by sensorLabel
	std::vector<std::string> absent;			 ///< Folders that are not there
	std::vector<std::string> notes;				 ///< What was measured and chosen on the way
	std::vector<std::string> warnings;			 ///< Bad rows too (the first 20)
	size_t bad_rows{0};							 ///< Left out with skip_bad
	size_t ground_truth_poses{0};
	double first_stamp{0}, last_stamp{0};  ///< Of the rawlog, UTC [s]
	std::optional<TWorldOptions> datum;
	std::string datum_source;  ///< "body.yaml", "ini", "first fix", "first row"; empty: none is known
	bool levelled{false};
	Eigen::Isometry3d T_FRD_body{Eigen::Isometry3d::Identity()};  ///< As used
	bool rectified{
		false};	 ///< Pictures were resampled (false: they were rectified already, or there are none)
	TStereoCamera camera;  ///< Where observations has STEREO

	/** For the terminal, a line each; the levelling matrix as it goes into body.yaml. */
	std::string text() const;
};

/** What is being done, and which part of it, 0 to 1. Called from the caller's thread. */
using dataset_progress_t = std::function<void(const std::string& stage, double fraction)>;

/** Reads a folder of `format` and writes rawlog, pictures (where there are some), ground truth and
 * sensors.ini: see this library's README for the layout. All or nothing: no file stays behind when something
 * is wrong. Labels: IMU AHRS DVL PRESSURE GPS ODOMETRY STEREO. Throws CError that names file and line. */
TDatasetReport importDataset(const TDatasetOptions& options, const dataset_progress_t& progress = {});
}  // namespace posidonia
