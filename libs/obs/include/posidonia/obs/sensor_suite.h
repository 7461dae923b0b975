#pragma once

#include <posidonia/base/ini_file.h>
#include <posidonia/geometry/se3.h>
#include <posidonia/geometry/stereo_camera.h>

#include <map>
#include <string>

/** What a rawlog has no place for: noise densities, sigmas, rates, poses and calibration of each sensorLabel.
 * They live in <name>.sensors.ini, one section a label with its `kind`; the run's ini may override single
 * keys in a section [Sensor.<label>]. */
namespace posidonia
{
/** Pose and rate of any sensor. */
struct TSensorMount
{
	std::vector<double> pose{0, 0, 0, 0, 0, 0};	 ///< x y z [m] yaw pitch roll [deg] of the sensor on the body
	double rate{1};								 ///< [Hz]

	Eigen::Isometry3d T_body_sensor() const;
	static std::vector<double> poseNumbers(const Eigen::Isometry3d& T_body_sensor);

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.numbers("pose", pose, 6, anyNumber(), "T_body_sensor: x y z [m] yaw pitch roll [deg]");
		v.number("rate", rate, above(0), "Nominal rate [Hz]");
	}
};

/** Gyroscope and accelerometer (CObservationIMU with rates and specific force). */
struct TImuSpec : TSensorMount
{
	static constexpr const char* kind = "imu";
	double gyro_noise_density{3.394e-4};  ///< [rad/s/sqrt(Hz)] (ADIS16448, uuv_simulator's IMU set)
	double gyro_random_walk{3.879e-5};	  ///< [rad/s^2/sqrt(Hz)]
	double accel_noise_density{4e-3};	  ///< [m/s^2/sqrt(Hz)]
	double accel_random_walk{6e-3};		  ///< [m/s^3/sqrt(Hz)]
	TImuSpec() { rate = 50; }

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		TSensorMount::visit(v);
		v.number("gyroscope_noise_density", gyro_noise_density, atLeast(0), "White noise [rad/s/sqrt(Hz)]");
		v.number(
			"gyroscope_random_walk", gyro_random_walk, atLeast(0), "Bias random walk [rad/s^2/sqrt(Hz)]");
		v.number(
			"accelerometer_noise_density", accel_noise_density, atLeast(0), "White noise [m/s^2/sqrt(Hz)]");
		v.number(
			"accelerometer_random_walk", accel_random_walk, atLeast(0), "Bias random walk [m/s^3/sqrt(Hz)]");
	}
};

/** Attitude and heading reference (CObservationIMU with an orientation: the sensor's attitude in map axes).
 */
struct TAhrsSpec : TSensorMount
{
	static constexpr const char* kind = "ahrs";
	double sigma_roll_pitch{0.2 * M_PI / 180};	///< [rad]
	double sigma_heading{0.5 * M_PI / 180};		///< [rad]
	/** The part that wanders (soft iron, filter lag): first-order Gauss-Markov about the map axes. */
	double sigma_tilt_bias{0}, sigma_heading_bias{0};  ///< [rad]
	double bias_time{600};							   ///< Its correlation time [s]
	/** True heading = heading read + declination (east is positive); 0 where the instrument applies it. */
	double declination{0};	///< [rad]
	TAhrsSpec() { rate = 20; }

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		TSensorMount::visit(v);
		v.degrees("sigma_roll_pitch", sigma_roll_pitch, above(0), "White noise of roll and pitch [deg]");
		v.degrees("sigma_heading", sigma_heading, above(0), "White noise of the heading [deg]");
		v.degrees(
			"sigma_tilt_bias", sigma_tilt_bias, atLeast(0),
			"Wandering error of roll and of pitch (Gauss-Markov) [deg]");
		v.degrees(
			"sigma_heading_bias", sigma_heading_bias, atLeast(0),
			"Wandering error of the heading (Gauss-Markov) [deg]");
		v.number("bias_time", bias_time, above(0), "Correlation time of the wandering errors [s]");
		v.degrees(
			"declination", declination, between(-180, 180),
			"Magnetic declination, east positive: true heading = heading read + this [deg]");
	}
};

struct TDvlSpec : TSensorMount
{
	static constexpr const char* kind = "dvl";
	double sigma_velocity{0.0015};		 ///< Of x and y, one ping [m/s] (COLA2's simulated sensor)
	double beam_angle{30 * M_PI / 180};	 ///< Off the instrument's z axis [rad]
	double beam_azimuth{0};				 ///< Of the first beam, from the x axis towards the y axis [rad]
	double sigma_scale{0.003};	///< Of measured / true velocity - 1, constant (600 kHz: 0.3 to 0.4 %)
	TDvlSpec() { rate = 5; }

	/** Unit vectors of the four beams (columns) in the instrument's frame, 90 deg of azimuth apart, off the
	 * half of its z axis that looks down in this mounting. */
	Eigen::Matrix<double, 3, 4> beams() const;
	/** White noise of one beam such that four of them give `sigma_velocity` across the z axis [m/s]. */
	double sigmaBeam() const { return M_SQRT2 * std::sin(beam_angle) * sigma_velocity; }
	/** White noise of the z axis, of four beams [m/s]. */
	double sigmaAlong() const { return sigmaBeam() / (2 * std::cos(beam_angle)); }

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		TSensorMount::visit(v);
		v.number(
			"sigma_velocity", sigma_velocity, above(0),
			"White noise of the velocity's x and y, one ping; z and the beams follow by geometry [m/s]");
		v.degrees("beam_angle", beam_angle, between(1, 60), "Beams off the instrument's z axis [deg]");
		v.degrees(
			"beam_azimuth", beam_azimuth, between(-180, 180),
			"First beam from the x axis towards the y axis, the others 90 apart [deg]");
		v.number(
			"sigma_scale", sigma_scale, between(0, 0.2),
			"Constant error of the scale: measured / true velocity - 1");
	}
};

struct TPressureSpec : TSensorMount
{
	static constexpr const char* kind = "pressure";
	double sigma{100};				  ///< [Pa] (1 cm)
	double surface_pressure{101325};  ///< [Pa]
	double water_density{1030};		  ///< [kg/m^3] (COLA2)
	double sigma_offset{0};			  ///< Error of surface_pressure at the start [Pa]
	double offset_walk{0};			  ///< Its random walk: weather, tide, temperature [Pa/sqrt(s)]
	TPressureSpec() { rate = 5; }

	/** Depth of the sensor below the surface [m] from absolute pressure [Pa]. */
	double depth(double pressure) const;
	/** Absolute pressure [Pa] at a depth [m]. */
	double pressureAt(double depth) const;
	double sigmaDepth() const;	///< [m]

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		TSensorMount::visit(v);
		v.number("sigma", sigma, above(0), "White noise [Pa]");
		v.number("surface_pressure", surface_pressure, above(0), "Absolute pressure at the surface [Pa]");
		v.number("water_density", water_density, between(900, 1100), "[kg/m^3]");
		v.number("sigma_offset", sigma_offset, atLeast(0), "Error of surface_pressure at the start [Pa]");
		v.number(
			"offset_walk", offset_walk, atLeast(0),
			"Its random walk: weather, tide, temperature [Pa/sqrt(s)]");
	}
};

struct TGpsSpec : TSensorMount
{
	static constexpr const char* kind = "gps";
	double sigma_horizontal{0.5};  ///< [m]
	double sigma_bias{0};		   ///< Part that wanders (atmosphere, orbits): Gauss-Markov [m]
	double bias_time{300};		   ///< Its correlation time [s]
	TGpsSpec() { rate = 1; }

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		TSensorMount::visit(v);
		v.number("sigma_horizontal", sigma_horizontal, above(0), "White noise, north and east [m]");
		v.number("sigma_bias", sigma_bias, atLeast(0), "Wandering error, north and east (Gauss-Markov) [m]");
		v.number("bias_time", bias_time, above(0), "Correlation time of the wandering error [s]");
	}
};

/** Rectified rig; `pose` is that of the LEFT camera: T_body_camera. */
struct TStereoSpec : TSensorMount
{
	static constexpr const char* kind = "stereo";
	TStereoCamera camera;
	TStereoSpec();

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		TSensorMount::visit(v);
		v.integer("width", camera.width, atLeast(16), "Image width [px]");
		v.integer("height", camera.height, atLeast(16), "Image height [px]");
		v.number("fx", camera.fx, above(0), "Focal length, columns [px] (97 deg over 640 px: 283)");
		v.number("fy", camera.fy, above(0), "Focal length, rows [px]");
		v.number("cx", camera.cx, anyNumber(), "Principal point, column [px]");
		v.number("cy", camera.cy, anyNumber(), "Principal point, row [px]");
		v.number("baseline", camera.baseline, above(0), "Distance of the two cameras [m]");
	}
};

/** Every sensor of a vehicle by its sensorLabel. */
struct TSensorSuite
{
	std::map<std::string, TImuSpec> imu;
	std::map<std::string, TAhrsSpec> ahrs;
	std::map<std::string, TDvlSpec> dvl;
	std::map<std::string, TPressureSpec> pressure;
	std::map<std::string, TGpsSpec> gps;
	std::map<std::string, TStereoSpec> stereo;

	/** SPARUS II with one sensor of each kind, labels IMU AHRS DVL PRESSURE GPS STEREO (poses: Stonefish's
	 * sparus2.scn, see docs; camera in the payload bay). */
	static TSensorSuite sparus2();
};

/** Reads <name>.sensors.ini strictly. Throws CError: unknown kind, unknown key, bad number, missing file. */
TSensorSuite readSensors(const std::string& path);
/** Overrides keys of `suite` by the sections [Sensor.<label>] of a run's ini. */
void overrideSensors(TSensorSuite& suite, CIniFile& run);
/** Writes <name>.sensors.ini, whole. */
void writeSensors(const std::string& path, const TSensorSuite& suite);

/** <name>.sensors.ini beside <name>.rawlog. */
std::string sensorsPathOf(const std::string& rawlog_path);

/** The entry of `label`; throws CError naming the label and the way out when there is none. */
template <class SPEC>
const SPEC& specOf(const std::map<std::string, SPEC>& entries, const std::string& label);
}  // namespace posidonia

#include <posidonia/base/error.h>

template <class SPEC>
const SPEC& posidonia::specOf(const std::map<std::string, SPEC>& entries, const std::string& label)
{
	const auto found = entries.find(label);
	if (found == entries.end())
		throw CError(
			"sensor '" + label + "'",
			std::string("has no entry of kind ") + SPEC::kind + " in the sensors.ini",
			"add a section [" + label + "], or give --assume-defaults");
	return found->second;
}
