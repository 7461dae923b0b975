#include <posidonia/base/error.h>
#include <posidonia/nav/navigator_setup.h>

namespace posidonia
{
TNavigatorSetup::TNavigatorSetup(
	const TEkfOptions& o, const TDragOptions& model, const TInitialPoseOptions& s, const TSensorSuite& suite,
	const TWorldOptions& d)
	: options(o), drag(model), start(s), sensors(suite), datum(d)
{
	chooseDrive();
	// Where no accelerometer drives, the body's origin is the point whose velocity changes least.
	if (drive == EDrive::INERTIAL) origin = -sensors.imu.begin()->second.T_body_sensor().translation();
	addSensors();
	noise = motionNoise();
	if (driving_imu < 0) return;
	const TImuSpec& imu = sensors.imu.begin()->second;
	rate_variance = imu.gyro_noise_density * imu.gyro_noise_density * imu.rate;
}

void TNavigatorSetup::chooseDrive()
{
	if (options.mode == "kinematic" || options.mode == "cola2") {
		drive = EDrive::KINEMATIC;
		return;
	}
	drive = options.mode == "gyro" ? EDrive::GYRO : EDrive::INERTIAL;
	if (sensors.imu.empty())
		throw CError(
			"sensors", "there is no gyro (kind imu), which [Ekf] mode = " + options.mode + " needs",
			"add a section with kind = imu to the sensors.ini, or set mode = kinematic");
}

template <class SPEC>
TNavigatorSetup::TSensor& TNavigatorSetup::add(const std::string& label, const SPEC& spec, double time_out)
{
	const int known = indexOf(label);
	if (known < 0) sensor.emplace_back();
	TSensor& s = known < 0 ? sensor.back() : sensor[static_cast<size_t>(known)];
	s.label = label;
	s.lever = spec.T_body_sensor().translation() + origin;
	s.time_out = time_out;
	return s;
}

void TNavigatorSetup::addSensors()
{
	const auto& o = options;
	for (const auto& [label, spec] : sensors.imu)
		add(label, spec, o.imu_time_out).imu = &spec;
	for (const auto& [label, spec] : sensors.ahrs)
		add(label, spec, o.imu_time_out).ahrs = &spec;
	for (const auto& [label, spec] : sensors.dvl) {
		TSensor& s = add(label, spec, o.dvl_time_out);
		s.dvl = &spec;
		s.dvl_mount = {spec.T_body_sensor().linear().transpose(), s.lever};
		s.dvl_beams = spec.beams();
	}
	for (const auto& [label, spec] : sensors.pressure)
		add(label, spec, o.pressure_time_out).pressure = &spec;
	for (const auto& [label, spec] : sensors.gps)
		add(label, spec, 0).gps = &spec;
	for (const auto& [label, spec] : sensors.stereo)
		add(label, spec, 0);
	if (drive != EDrive::KINEMATIC) driving_imu = indexOf(sensors.imu.begin()->first);
}

TMotionNoise TNavigatorSetup::motionNoise() const
{
	TMotionNoise n;
	n.acceleration = options.acceleration_density;
	n.turn = options.turn_density;
	if (!sensors.imu.empty()) {
		const TImuSpec& imu = sensors.imu.begin()->second;
		n.gyro = imu.gyro_noise_density;
		n.gyro_walk = imu.gyro_random_walk;
		n.accel = imu.accel_noise_density;
		n.accel_walk = imu.accel_random_walk;
	}
	// One state serves a kind: the first by label is its model.
	if (!sensors.pressure.empty()) {
		const TPressureSpec& p = sensors.pressure.begin()->second;
		n.offset_walk = p.offset_walk * p.sigmaDepth() / p.sigma;
	}
	if (!sensors.ahrs.empty()) {
		const TAhrsSpec& a = sensors.ahrs.begin()->second;
		n.tilt_bias = {a.sigma_tilt_bias, a.bias_time};
		n.heading_bias = {a.sigma_heading_bias, a.bias_time};
	}
	if (!sensors.gps.empty()) {
		const TGpsSpec& g = sensors.gps.begin()->second;
		n.gps_bias = {g.sigma_bias, g.bias_time};
	}
	return n;
}

Eigen::Matrix<double, 7, 1> TNavigatorSetup::startVariance() const
{
	Eigen::Matrix<double, 7, 1> sigma = Eigen::Matrix<double, 7, 1>::Zero();
	if (!sensors.dvl.empty()) sigma[0] = sensors.dvl.begin()->second.sigma_scale;
	if (!sensors.pressure.empty()) {
		const TPressureSpec& p = sensors.pressure.begin()->second;
		sigma[1] = p.sigma_offset * p.sigmaDepth() / p.sigma;
	}
	sigma.segment<2>(2).setConstant(noise.tilt_bias.sigma);
	sigma[4] = noise.heading_bias.sigma;
	sigma.segment<2>(5).setConstant(noise.gps_bias.sigma);
	return sigma.cwiseAbs2();
}

int TNavigatorSetup::indexOf(const std::string& label) const
{
	for (size_t i = 0; i < sensor.size(); i++)
		if (sensor[i].label == label) return static_cast<int>(i);
	return -1;
}

Eigen::Isometry3d TNavigatorSetup::T_nav_body() const
{
	return Eigen::Isometry3d(Eigen::Translation3d(origin));
}
}  // namespace posidonia
