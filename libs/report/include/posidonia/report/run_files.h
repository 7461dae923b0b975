#pragma once

#include <posidonia/geometry/se3.h>
#include <posidonia/obs/geodesy.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

/** The files of a run folder that its report is made of, beside trajectories, loops.csv and metrics.json:
 * what each row is, how it is written and read. Readers throw CError "<file>:<line>: ...". */
namespace posidonia
{
/** run.json: what the run was. */
struct TRunInfo
{
	std::string app;	   ///< "auv-graphslam"
	std::string title;	   ///< Of the log or the ini
	std::string versions;  ///< Text of --version
	std::string truth;	   ///< File of the folder with the true poses; empty: none is known
	bool interrupted{false};
	double start{0}, duration{0};  ///< UTC [s], [s]
	TWorldOptions datum;		   ///< Of `map`
};
std::string runInfoJson(const TRunInfo& info);
TRunInfo readRunInfo(const std::string& path);

/** A row of poses.csv: a node after the last optimisation. */
struct TNodeRow
{
	int node{0};
	double stamp{0};  ///< UTC [s]
	Eigen::Isometry3d T_map_body{Eigen::Isometry3d::Identity()};
	/** Of north, east, down [m] and of the rotation vector about north, east, down [rad]. */
	Matrix6d covariance{Matrix6d::Zero()};
	int points{0};		  ///< Of its key frame
	double altitude{0};	  ///< Camera above the floor, the median of these points [m]; 0: no points
	std::string picture;  ///< File of the folder; empty: none
};
std::string nodesCsv(const std::vector<TNodeRow>& rows);
std::vector<TNodeRow> readNodes(const std::string& path);
/** Covariance in map axes of one over (rho, phi) in the body's (geometry/se3.h). */
Matrix6d covarianceInMap(const Eigen::Isometry3d& T_map_body, const Matrix6d& covariance);

/** A row of matches.csv: an accepted pair, and where its inliers lie in both left pictures. */
struct TMatchesRow
{
	int from{0}, to{0};
	double chi2{0};	 ///< Of the edge at the last poses, before its robust loss
	/** (u, v) in the picture of `from` and in that of `to` [px]. */
	std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> points;
};
std::string matchesCsv(const std::vector<TMatchesRow>& rows);
std::vector<TMatchesRow> readMatches(const std::string& path);

/** A row of sensors.csv: how a sensor did. */
struct TSensorRow
{
	std::string name;
	size_t used{0};
	double rate{0};			///< Of those used, over the run [Hz]
	double longest_gap{0};	///< [s]
	std::map<std::string, size_t> rejected;
};
std::string sensorsCsv(const std::vector<TSensorRow>& rows);
std::vector<TSensorRow> readSensorRows(const std::string& path);

/** A row of timings.csv. */
struct TTimingRow
{
	std::string stage;
	size_t calls{0};
	double mean_ms{0}, max_ms{0}, total_s{0};
};
std::vector<TTimingRow> readTimings(const std::string& path);

/** A row of events.csv: t [s from the start],kind,"text". */
struct TEventRow
{
	double t{0};
	std::string kind, text;
};
std::vector<TEventRow> readEvents(const std::string& path);

/** A table of numbers under names: control.csv. A cell that is no number reads as NaN. */
struct TNumberTable
{
	std::map<std::string, std::vector<double>> columns;
	const std::vector<double>& column(const std::string& name) const;  ///< Throws CError when it is not there
};
TNumberTable readNumberTable(const std::string& path);
}  // namespace posidonia
