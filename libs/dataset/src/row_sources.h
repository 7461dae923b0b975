#pragma once

#include <mrpt/obs/CObservation.h>
#include <posidonia/dataset/csv_reader.h>
#include <posidonia/dataset/import_dataset.h>
#include <posidonia/dataset/sensor_yaml.h>
#include <posidonia/dataset/world_axes.h>
#include <posidonia/obs/sensor_suite.h>

#include <functional>
#include <memory>
#include <optional>

namespace posidonia
{
/** An observation with the integer stamp of its row. */
struct TStampedObservation
{
	int64_t stamp{0};  ///< [ns]
	mrpt::obs::CObservation::Ptr observation;
};

/** A stream of observations in the order of their stamps. */
struct TSource
{
	std::string label;
	std::function<std::optional<TStampedObservation>()> next;
};

/** What the sources need and what they find out on the way. */
struct TImport
{
	TImport(const TDatasetOptions& o, const std::string& mav0_folder)
		: options(o), mav0(mav0_folder), bad(o.skip_bad)
	{
	}

	const TDatasetOptions& options;
	std::string mav0;
	CBadRows bad;
	TWorldAxes axes;
	TSensorSuite suite;
	TDatasetReport report;
	std::vector<double> gps_sigmas;	 ///< Of the rows with a fix [m]
};

/** Stamp of MRPT (100 ns ticks since 1601) of UTC nanoseconds. */
mrpt::system::TTimeStamp mrptStamp(int64_t utc_ns);

/** A line of a TUM file: t x y z qx qy qz qw, with the row's own nanoseconds. */
std::string tumLine(int64_t stamp, const Eigen::Isometry3d& T);

/** Streams of imu0, ahrs0, dvl0, pressure0, gps0 and odom0, as far as they exist; fills `suite` from their
 * yaml. */
std::vector<TSource> openRowSources(TImport& import);

/** Poses of state_groundtruth_estimate0 as text lines of TUM: T_map_body. Empty where the folder is absent.
 */
std::optional<std::string> readGroundTruth(TImport& import);
}  // namespace posidonia
