#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/dataset/sensor_yaml.h>
#include <posidonia/dataset/world_axes.h>
#include <posidonia/geometry/se3.h>
#include <posidonia/obs/frames.h>

#include <filesystem>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

std::optional<Matrix3d> mapFromWorld(const std::string& name)
{
	Matrix3d R;
	if (name == "NED") return Matrix3d::Identity();
	if (name == "ENU") return (R << 0, 1, 0, 1, 0, 0, 0, 0, -1).finished();
	if (name == "NWU") return (R << 1, 0, 0, 0, -1, 0, 0, 0, -1).finished();
	return {};
}

Matrix3d TWorldAxes::defaultWorld()
{
	return *mapFromWorld("NWU");
}

Isometry3d TWorldAxes::mapPose(const Isometry3d& T_world_setbody) const
{
	return Isometry3d(R_map_world) * T_world_setbody * T_FRD_body.inverse();
}

namespace
{
/** `frame: NED` says world and body in one word: nothing else may be said then. */
void checkFrame(const CSensorYaml& yaml)
{
	if (!yaml.has("frame")) return;
	if (yaml.text("frame") != "NED")
		throw CError(yaml.where("frame"), "frame: only NED is known", "or give world: and T_FRD_body:");
	if ((yaml.has("world") && yaml.text("world") != "NED") || yaml.has("T_FRD_body"))
		throw CError(
			yaml.where("frame"), "frame: NED already says world: NED and a forward-starboard-down body",
			"remove it, or remove world and T_FRD_body");
}

Matrix3d worldOf(const CSensorYaml& yaml)
{
	if (yaml.has("frame")) return Matrix3d::Identity();
	if (!yaml.has("world")) return TWorldAxes::defaultWorld();
	const auto R = mapFromWorld(yaml.text("world"));
	if (!R)
		throw CError(
			yaml.where("world"), "world: '" + yaml.text("world") + "' is not known", "NED, ENU or NWU");
	return *R;
}

TWorldOptions datumOf(const CSensorYaml& yaml)
{
	const auto position = yaml.numbers("datum", 2);
	if (std::abs(position[0]) > 89.9 || std::abs(position[1]) > 180)
		throw CError(
			yaml.where("datum"), "datum: no latitude and longitude [deg]", "datum: [latitude, longitude]");
	TWorldOptions datum;
	datum.latitude = position[0];
	datum.longitude = position[1];
	return datum;
}
}  // namespace

TWorldAxes readBodyYaml(const std::string& path)
{
	TWorldAxes axes;
	if (!std::filesystem::exists(path)) return axes;
	const CSensorYaml yaml(path);
	checkFrame(yaml);
	axes.R_map_world = worldOf(yaml);
	if (yaml.has("T_FRD_body")) axes.T_FRD_body = yaml.pose("T_FRD_body");
	if (yaml.has("datum")) axes.datum = datumOf(yaml);
	axes.warnings = yaml.unknownKeys({"world", "frame", "T_FRD_body", "datum", "comment"});
	return axes;
}

Matrix3d levellingRotation(const Vector3d& force)
{
	// f = R^T (0, 0, -g) = g (sin p, -cos p sin r, -cos p cos r)
	const double pitch = std::atan2(force.x(), std::hypot(force.y(), force.z()));
	const double roll = std::atan2(-force.y(), -force.z());
	return rotationFromYawPitchRoll(0, pitch, roll);
}

Vector3d meanForceOfFirstSecond(const std::string& imu_csv, CBadRows& bad)
{
	CCsvReader rows(imu_csv, {7}, false, bad);
	Vector3d sum = Vector3d::Zero();
	int n = 0;
	std::optional<int64_t> start;
	while (const auto row = rows.next()) {
		if (!start) start = row->stamp;
		if (row->stamp - *start > 1000000000) break;
		try {
			sum += Vector3d(row->number(4), row->number(5), row->number(6));
			n++;
		}
		catch (const CRowProblem& problem) {
			rows.refuse(*row, problem.what());
		}
	}
	const Vector3d mean = sum / std::max(n, 1);
	if (n < 10 || std::abs(mean.norm() - kGravity) > 0.05 * kGravity)
		throw CError(
			imu_csv,
			"levelling needs the vehicle at rest in the first second: " + std::to_string(n) +
				" rows with a mean force of " + std::to_string(mean.norm()) + " m/s^2",
			"give T_FRD_body in body.yaml instead of --level");
	return mean;
}

Matrix3d rotationOfColumns(const TCsvRow& row, size_t i)
{
	const Eigen::Quaterniond q(row.number(i), row.number(i + 1), row.number(i + 2), row.number(i + 3));
	if (std::abs(q.norm() - 1) > 0.02)
		throw CRowProblem(
			"quaternion in columns " + std::to_string(i + 1) + " to " + std::to_string(i + 4) +
			" is not of length 1");
	return q.normalized().toRotationMatrix();
}
}  // namespace posidonia
