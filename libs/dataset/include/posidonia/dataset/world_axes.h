#pragma once

#include <posidonia/dataset/csv_reader.h>
#include <posidonia/obs/geodesy.h>

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

namespace posidonia
{
/** The axes of a set's world and body, and how they become north-east-down and forward-starboard-down.
 *
 *   T_map_body = R_map_world * T_world_setbody * inverse(T_FRD_body)
 *   T_body_sensor = T_FRD_body * T_BS */
struct TWorldAxes
{
	Eigen::Matrix3d R_map_world{defaultWorld()};
	Eigen::Isometry3d T_FRD_body{Eigen::Isometry3d::Identity()};
	std::optional<TWorldOptions> datum;	 ///< body.yaml's
	std::vector<std::string> warnings;

	/** Pose of the set's body in the set's world, as T_map_body. */
	Eigen::Isometry3d mapPose(const Eigen::Isometry3d& T_world_setbody) const;
	/** T_body_sensor from T_BS. */
	Eigen::Isometry3d mount(const Eigen::Isometry3d& T_BS) const { return T_FRD_body * T_BS; }

	static Eigen::Matrix3d defaultWorld();	///< NWU: z up
};

/** Rotation to north-east-down of NED, ENU or NWU coordinates; empty for another name. */
std::optional<Eigen::Matrix3d> mapFromWorld(const std::string& name);

/** Reads <mav0>/body.yaml; the defaults where it does not exist. Throws CError for what contradicts itself.
 */
TWorldAxes readBodyYaml(const std::string& path);

/** Rotation that levels the body: Ry(pitch) Rx(roll) with R f = (0, 0, -|f|), f the mean specific force
 * [m/s^2] of the body at rest (the heading can't be known from gravity and stays). */
Eigen::Matrix3d levellingRotation(const Eigen::Vector3d& force);

/** Mean specific force in the IMU's frame [m/s^2] over the first second of imu0/data.csv. Throws CError when
 * there are under 10 rows, or when the mean is no gravity (9.81 +- 5 %): the vehicle was not at rest. */
Eigen::Vector3d meanForceOfFirstSecond(const std::string& imu_csv, CBadRows& bad);

/** Reads a unit quaternion w, x, y, z from columns i to i+3; throws CRowProblem when it is none (2 %). */
Eigen::Matrix3d rotationOfColumns(const TCsvRow& row, size_t i);
}  // namespace posidonia
