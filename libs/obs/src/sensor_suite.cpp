#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/obs/frames.h>
#include <posidonia/obs/sensor_suite.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
constexpr double kDegree = M_PI / 180;

struct TKind
{
	std::string kind;
	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice("kind", kind, {"imu", "ahrs", "dvl", "pressure", "gps", "stereo"}, "Kind of sensor");
	}
};

/** Calls f(kind's map) for the map whose kind is `kind`. */
template <class SUITE, class F>
void forKind(SUITE& suite, const std::string& kind, F&& f)
{
	const auto call = [&](auto& entries) {
		using spec_t = typename std::decay_t<decltype(entries)>::mapped_type;
		if (kind == spec_t::kind) f(entries);
	};
	call(suite.imu), call(suite.ahrs), call(suite.dvl), call(suite.pressure), call(suite.gps),
		call(suite.stereo);
}

template <class SUITE, class F>
void forEachSpec(SUITE& suite, F&& f)
{
	for (const char* kind : {"imu", "ahrs", "dvl", "pressure", "gps", "stereo"})
		forKind(suite, kind, [&](auto& entries) {
			for (auto& [label, spec] : entries)
				f(label, spec);
		});
}
}  // namespace

Isometry3d TSensorMount::T_body_sensor() const
{
	Isometry3d T = Isometry3d::Identity();
	T.translation() << pose[0], pose[1], pose[2];
	T.linear() = rotationFromYawPitchRoll(pose[3] * kDegree, pose[4] * kDegree, pose[5] * kDegree);
	return T;
}

std::vector<double> TSensorMount::poseNumbers(const Isometry3d& T)
{
	const Vector3d t = T.translation(), ypr = yawPitchRoll(T.linear()) / kDegree;
	return {t.x(), t.y(), t.z(), ypr.x(), ypr.y(), ypr.z()};
}

Eigen::Matrix<double, 3, 4> TDvlSpec::beams() const
{
	const double down = T_body_sensor().linear()(2, 2) >= 0 ? 1 : -1;
	Eigen::Matrix<double, 3, 4> unit;
	for (int i = 0; i < 4; i++) {
		const double azimuth = beam_azimuth + i * M_PI_2;
		unit.col(i) << std::sin(beam_angle) * std::cos(azimuth), std::sin(beam_angle) * std::sin(azimuth),
			down * std::cos(beam_angle);
	}
	return unit;
}

double TPressureSpec::depth(double p) const
{
	return (p - surface_pressure) / (water_density * kGravity);
}
double TPressureSpec::pressureAt(double depth) const
{
	return surface_pressure + water_density * kGravity * depth;
}
double TPressureSpec::sigmaDepth() const
{
	return sigma / (water_density * kGravity);
}

TStereoSpec::TStereoSpec()
{
	rate = 3;
	pose = {0.55, 0, 0.10, 90, 0, 0};  // downLookingCamera(): x starboard, y aft, z down
}

TSensorSuite TSensorSuite::sparus2()
{
	TSensorSuite s;
	s.imu["IMU"].pose = {0.36377, -0.02093, -0.0849, 0, 0, 0};
	s.ahrs["AHRS"].pose = {0.36377, -0.02093, -0.0849, 0, 0, 0};
	s.dvl["DVL"].pose = {-0.4145, 0, 0.11, 135, 0, 180};
	s.pressure["PRESSURE"].pose = {0.387, 0, -0.033, 0, 0, 0};
	s.gps["GPS"].pose = {-0.39, 0, -0.36, 0, 0, 0};
	s.stereo["STEREO"] = TStereoSpec();
	return s;
}

TSensorSuite readSensors(const std::string& path)
{
	requireFile(path, "write one (docs/rawlog-format.md), or give --assume-defaults");
	CIniFile ini = CIniFile::fromFile(path);
	TSensorSuite suite;
	for (const std::string& label : ini.sections()) {
		const std::string kind = ini.load<TKind>(label).kind;
		if (kind.empty())
			throw CError(path, "[" + label + "] has no key 'kind'", "add kind = imu, dvl, stereo ...");
		forKind(suite, kind, [&](auto& entries) { ini.loadOnto(entries[label], label); });
	}
	ini.refuseUnknown();
	return suite;
}

void overrideSensors(TSensorSuite& suite, CIniFile& run)
{
	forEachSpec(suite, [&](const std::string& label, auto& spec) { run.loadOnto(spec, "Sensor." + label); });
}

void writeSensors(const std::string& path, const TSensorSuite& suite)
{
	TSensorSuite copy = suite;
	writeFileWhole(path, [&](std::ostream& out) {
		out << "// Sensors of the rawlog beside this file: one section a sensorLabel.\n\n";
		forEachSpec(copy, [&](const std::string& label, auto& spec) {
			out << "[" << label << "]\nkind = " << std::decay_t<decltype(spec)>::kind << "\n";
			for (const auto& row : listOptions(spec))
				out << "// " << row.text << "\n" << row.key << " = " << row.value << "\n";
			out << "\n";
		});
	});
}

std::string sensorsPathOf(const std::string& rawlog_path)
{
	const auto dot = rawlog_path.rfind(".rawlog");
	return rawlog_path.substr(0, dot) + ".sensors.ini";
}
}  // namespace posidonia
