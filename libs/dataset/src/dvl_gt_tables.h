#pragma once

#include <posidonia/dataset/bad_rows.h>
#include <posidonia/obs/geodesy.h>

#include <Eigen/Dense>
#include <cstdint>
#include <string>
#include <vector>

namespace posidonia
{
/** A row of DVL.csv. */
struct TDvlRow
{
	int64_t stamp{0};		   ///< [ns]
	Eigen::Vector3d velocity;  ///< Forward, starboard, down [m/s]
};

/** A row of GT.csv. */
struct TTruthRow
{
	int64_t stamp{0};			 ///< [ns]
	TGeodetic position;			 ///< Height: the altitude, negative below the surface
	Eigen::Vector3d velocity;	 ///< North, east, down [m/s]
	Eigen::Matrix3d R_map_body;	 ///< Of the logged roll, pitch and yaw

	/** T_map_body: north and east from the datum, down = -altitude (the depth that a pressure sensor has, so
	 * without the earth's curvature, 8 mm at 300 m). */
	Eigen::Isometry3d T_map_body(const TWorldOptions& datum) const;
};

struct TDvlGtTables
{
	std::string folder;
	std::vector<TDvlRow> dvl;
	std::vector<TTruthRow> truth;
};

/** Reads FOLDER/DVL.csv and FOLDER/GT.csv. Throws CError naming file, line and column; bad rows go to `bad`,
 * and a table without any row is an error. */
TDvlGtTables readDvlGtTables(const std::string& folder, CBadRows& bad);

/** How the two tables, and GT.csv in itself, agree. */
struct TDvlGtAgreement
{
	size_t pings{0};									  ///< With a row of GT.csv at the same time
	Eigen::Vector3d dvl_mean{0, 0, 0}, dvl_rms{0, 0, 0};  ///< v_dvl - R^T v_truth, body axes [m/s]
	Eigen::Vector3d velocity_rms{0, 0, 0};				  ///< R^T v_truth at these pings [m/s]
	double down_rms{0};									  ///< Difference of -d(altitude)/dt and V Down [m/s]
	double vertical_rms{0};								  ///< V Down [m/s]
	double closure{0};	///< End of the summed velocities (trapezoid rule) off the position's [m]
	double way{0};		///< Length of the positions' way [m]

	/** Of one ping across, both axes with their means [m/s]. */
	double sigmaDvl() const;
	/** Warnings, where signs, axes or units seem to be other ones. */
	std::vector<std::string> warnings() const;
	/** In words, for the report. */
	std::vector<std::string> notes() const;
};
TDvlGtAgreement agreementOf(const TDvlGtTables& tables);
}  // namespace posidonia
