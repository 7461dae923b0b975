#include "row_sources.h"

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <posidonia/base/error.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/CObservationPressure.h>
#include <posidonia/obs/observations.h>

#include <filesystem>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;
using mrpt::obs::CObservation;

mrpt::system::TTimeStamp mrptStamp(int64_t utc_ns)
{
	constexpr int64_t kUnixEpoch = 116444736000000000;	// 100 ns ticks from 1601 to 1970
	return mrpt::Clock::time_point(mrpt::Clock::duration(utc_ns / 100 + kUnixEpoch));
}

namespace
{
bool isThere(TImport& import, const std::string& folder)
{
	const bool there = std::filesystem::is_directory(import.mav0 + "/" + folder);
	if (!there) import.report.absent.push_back(folder);
	return there;
}

/** Reads the keys of a sensor.yaml that are given; a warning names what is left at its default. */
class CSpecReader
{
   public:
	CSpecReader(TImport& import, const std::string& folder)
		: m_import(import), m_yaml(import.mav0 + "/" + folder + "/sensor.yaml")
	{
	}
	~CSpecReader()
	{
		for (const auto& message : m_yaml.unknownKeys(m_known))
			m_import.report.warnings.push_back(message);
	}
	CSpecReader(const CSpecReader&) = delete;
	CSpecReader& operator=(const CSpecReader&) = delete;

	void mount(TSensorMount& spec)
	{
		spec.pose = TSensorMount::poseNumbers(m_import.axes.mount(m_yaml.pose("T_BS")));
		value("rate_hz", spec.rate, above(0));
	}
	void value(const std::string& key, double& value, const TRange& range)
	{
		m_known.push_back(key);
		if (!m_yaml.has(key)) {
			m_import.report.warnings.push_back(
				m_yaml.path() + ": no " + key + ", " + std::to_string(value) + " is used");
			return;
		}
		const double x = m_yaml.number(key);
		if (!range.holds(x)) throw CError(m_yaml.where(key), key + " " + range.text(), "mend it");
		value = x;
	}

   private:
	TImport& m_import;
	CSensorYaml m_yaml;
	std::vector<std::string> m_known{"sensor_type", "comment", "T_BS"};
};

using convert_t = std::function<CObservation::Ptr(const TCsvRow&)>;

/** Columns of a data.csv: allowed counts, and whether more may follow. */
struct TColumns
{
	std::vector<size_t> counts;
	bool more{false};
};

TSource rowSource(
	TImport& import, const std::string& folder, const std::string& label, const TColumns& columns,
	convert_t convert)
{
	auto csv = std::make_shared<CCsvReader>(
		import.mav0 + "/" + folder + "/data.csv", columns.counts, columns.more, import.bad);
	const auto next = [csv, label, convert]() -> std::optional<TStampedObservation> {
		while (const auto row = csv->next()) {
			try {
				const auto observation = convert(*row);
				observation->sensorLabel = label;
				observation->timestamp = mrptStamp(row->stamp);
				return TStampedObservation{row->stamp, observation};
			}
			catch (const CRowProblem& problem) {
				csv->refuse(*row, problem.what());
			}
		}
		return {};
	};
	return {label, next};
}

TSource imuSource(TImport& import)
{
	TImuSpec& spec = import.suite.imu["IMU"];
	CSpecReader yaml(import, "imu0");
	yaml.mount(spec);
	yaml.value("gyroscope_noise_density", spec.gyro_noise_density, atLeast(0));
	yaml.value("gyroscope_random_walk", spec.gyro_random_walk, atLeast(0));
	yaml.value("accelerometer_noise_density", spec.accel_noise_density, atLeast(0));
	yaml.value("accelerometer_random_walk", spec.accel_random_walk, atLeast(0));
	const Isometry3d T = spec.T_body_sensor();
	return rowSource(import, "imu0", "IMU", {{7}}, [T](const TCsvRow& r) {
		return makeImu(
			"IMU", 0, T, {{r.number(1), r.number(2), r.number(3)}, {r.number(4), r.number(5), r.number(6)}});
	});
}

TSource ahrsSource(TImport& import)
{
	TAhrsSpec& spec = import.suite.ahrs["AHRS"];
	CSpecReader yaml(import, "ahrs0");
	yaml.mount(spec);
	yaml.value("sigma_roll_pitch", spec.sigma_roll_pitch, above(0));
	yaml.value("sigma_heading", spec.sigma_heading, above(0));
	const Isometry3d T = spec.T_body_sensor();
	const Eigen::Matrix3d R_map_world = import.axes.R_map_world;
	return rowSource(import, "ahrs0", "AHRS", {{5}}, [T, R_map_world](const TCsvRow& r) {
		return makeAhrs("AHRS", 0, T, R_map_world * rotationOfColumns(r, 1));
	});
}

/** v_x v_y v_z altitude valid [b_1 .. b_4]: without bottom lock the numbers may be NaN. */
CObservation::Ptr dvlOf(const TCsvRow& r)
{
	auto dvl = CObservationDVL::Create();
	dvl->velocity_valid = r.flag(5);
	const auto read = [&](size_t i) { return dvl->velocity_valid ? r.number(i) : r.numberOrNan(i); };
	const Vector3d v(read(1), read(2), read(3));
	if (v.allFinite()) dvl->velocity = {v.x(), v.y(), v.z()};
	const double altitude = r.numberOrNan(4);
	dvl->altitude_valid = altitude > 0;
	if (dvl->altitude_valid) dvl->altitude = altitude;
	for (size_t i = 6; i < r.fields.size(); i++)
		dvl->beam_velocities.push_back(r.numberOrNan(i));
	return dvl;
}

TSource dvlSource(TImport& import)
{
	TDvlSpec& spec = import.suite.dvl["DVL"];
	CSpecReader yaml(import, "dvl0");
	yaml.mount(spec);
	yaml.value("sigma_velocity", spec.sigma_velocity, above(0));
	double beam_angle = spec.beam_angle * 180 / M_PI;
	yaml.value("beam_angle_deg", beam_angle, between(1, 60));
	spec.beam_angle = beam_angle * M_PI / 180;
	const auto pose = toMrpt(spec.T_body_sensor());
	return rowSource(import, "dvl0", "DVL", {{6, 10}}, [pose](const TCsvRow& r) {
		auto dvl = dvlOf(r);
		dvl->setSensorPose(pose);
		return dvl;
	});
}

TSource pressureSource(TImport& import)
{
	TPressureSpec& spec = import.suite.pressure["PRESSURE"];
	CSpecReader yaml(import, "pressure0");
	yaml.mount(spec);
	yaml.value("sigma", spec.sigma, above(0));
	yaml.value("surface_pressure", spec.surface_pressure, above(0));
	yaml.value("water_density", spec.water_density, between(900, 1100));
	const auto pose = toMrpt(spec.T_body_sensor());
	return rowSource(import, "pressure0", "PRESSURE", {{2}}, [pose](const TCsvRow& r) {
		auto pressure = CObservationPressure::Create();
		pressure->pressure = r.number(1);
		if (pressure->pressure <= 0) throw CRowProblem("pressure must be > 0 [Pa], absolute");
		pressure->setSensorPose(pose);
		return pressure;
	});
}

/** Without a fix the position may be NaN. */
mrpt::obs::CObservationGPS::Ptr gpsOf(const TCsvRow& r)
{
	const bool fix = r.flag(5);
	const auto read = [&](size_t i) { return fix ? r.number(i) : r.numberOrNan(i); };
	mrpt::obs::gnss::Message_NMEA_GGA gga;
	gga.fields.latitude_degrees = read(1);
	gga.fields.longitude_degrees = read(2);
	gga.fields.altitude_meters = read(3);
	gga.fields.fix_quality = fix ? 1 : 0;
	if (fix && (std::abs(read(1)) > 90 || std::abs(read(2)) > 180))
		throw CRowProblem("is no latitude and longitude [deg]");
	if (fix && read(4) <= 0) throw CRowProblem("sigma_horizontal must be > 0 [m]");
	auto gps = mrpt::obs::CObservationGPS::Create();
	gps->setMsg(gga);
	return gps;
}

TSource gpsSource(TImport& import)
{
	TGpsSpec& spec = import.suite.gps["GPS"];
	CSpecReader(import, "gps0").mount(spec);
	const auto pose = toMrpt(spec.T_body_sensor());
	return rowSource(import, "gps0", "GPS", {{6}}, [&import, pose](const TCsvRow& r) {
		auto gps = gpsOf(r);
		gps->setSensorPose(pose);
		if (!r.flag(5)) return gps;
		import.gps_sigmas.push_back(r.number(4));
		if (import.report.datum) return gps;
		import.report.datum = TWorldOptions{r.number(1), r.number(2)};
		import.report.datum_source = "first fix";
		return gps;
	});
}

Isometry3d poseOfColumns(const TCsvRow& r)
{
	Isometry3d T = Isometry3d::Identity();
	T.translation() << r.number(1), r.number(2), r.number(3);
	T.linear() = rotationOfColumns(r, 4);
	return T;
}

TSource odometrySource(TImport& import)
{
	return rowSource(import, "odom0", "ODOMETRY", {{8}}, [&import](const TCsvRow& r) {
		auto pose = mrpt::obs::CObservationRobotPose::Create();
		pose->pose.mean = toMrpt(import.axes.mapPose(poseOfColumns(r)));
		return pose;
	});
}

}  // namespace

std::string tumLine(int64_t stamp, const Isometry3d& T)
{
	const Vector3d t = T.translation();
	const Eigen::Quaterniond q(T.linear());
	return mrpt::format(
		"%lld.%09lld %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", static_cast<long long>(stamp / 1000000000),
		static_cast<long long>(stamp % 1000000000), t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
}

std::vector<TSource> openRowSources(TImport& import)
{
	std::vector<TSource> sources;
	if (isThere(import, "imu0")) sources.push_back(imuSource(import));
	if (isThere(import, "ahrs0")) sources.push_back(ahrsSource(import));
	if (isThere(import, "dvl0")) sources.push_back(dvlSource(import));
	if (isThere(import, "pressure0")) sources.push_back(pressureSource(import));
	if (isThere(import, "gps0")) sources.push_back(gpsSource(import));
	if (isThere(import, "odom0")) sources.push_back(odometrySource(import));
	return sources;
}

std::optional<std::string> readGroundTruth(TImport& import)
{
	const std::string folder = "state_groundtruth_estimate0";
	if (!isThere(import, folder)) return {};
	CCsvReader csv(import.mav0 + "/" + folder + "/data.csv", {8}, true, import.bad);
	std::string lines;
	while (const auto row = csv.next()) {
		try {
			lines += tumLine(row->stamp, import.axes.mapPose(poseOfColumns(*row)));
			import.report.ground_truth_poses++;
		}
		catch (const CRowProblem& problem) {
			csv.refuse(*row, problem.what());
		}
	}
	return lines;
}
}  // namespace posidonia
