#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/base/error.h>
#include <posidonia/nav/ekf_odometry.h>
#include <posidonia/obs/observations.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using namespace mrpt::obs;

namespace
{
const std::string& drivingGyro(const TSensorSuite& sensors)
{
	if (sensors.imu.empty())
		throw CError(
			"sensors", "there is no gyro (kind imu)", "add a section with kind = imu to the sensors.ini");
	return sensors.imu.begin()->first;
}

TMotionNoise motionNoise(const TEkfOptions& options, const TImuSpec& gyro)
{
	return {options.acceleration_density, gyro.gyro_noise_density, gyro.gyro_random_walk};
}

/** The observation's own covariance, or that of sensors.ini where it states none. */
Matrix3d velocityCovariance(const CObservationDVL& dvl, const TDvlSpec& spec)
{
	const Matrix3d stated = dvl.velocity_covariance.asEigen();
	return stated.isZero(0) ? Matrix3d(spec.sigma_velocity * spec.sigma_velocity * Matrix3d::Identity())
							: stated;
}

bool isValid(const CObservationDVL& dvl, double max_speed)
{
	const Vector3d v(dvl.velocity.x, dvl.velocity.y, dvl.velocity.z);
	return dvl.velocity_valid && v.allFinite() && v.cwiseAbs().maxCoeff() <= max_speed;
}

/** Latitude and longitude of a fix; height is left at 0: depth never passes through GPS. */
std::optional<TGeodetic> fixOf(const CObservationGPS& gps)
{
	if (!gps.has_GGA_datum()) return {};
	const auto& gga = gps.getMsgByClass<gnss::Message_NMEA_GGA>().fields;
	const TGeodetic fix{gga.latitude_degrees, gga.longitude_degrees, 0};
	if (gga.fix_quality == 0 || !std::isfinite(fix.latitude) || !std::isfinite(fix.longitude)) return {};
	return fix;
}
}  // namespace

CEkfOdometry::CEkfOdometry(
	const TEkfOptions& options, const TInitialPoseOptions& start, const TSensorSuite& sensors,
	const TWorldOptions& datum)
	: m_options(options),
	  m_sensors(sensors),
	  m_datum(datum),
	  m_gyro_label(drivingGyro(sensors)),
	  m_nav(motionNoise(options, sensors.imu.begin()->second), options.gate_probability),
	  m_edge(motionNoise(options, sensors.imu.begin()->second), options.gate_probability),
	  m_initializer(start)
{
	const TImuSpec& gyro = sensors.imu.begin()->second;
	m_rate.variance = gyro.gyro_noise_density * gyro.gyro_noise_density * gyro.rate;
}

void CEkfOdometry::add(const CObservation& o)
{
	const double t = stampOf(o);
	if (const auto* imu = dynamic_cast<const CObservationIMU*>(&o))
		addImu(*imu, t);
	else if (const auto* dvl = dynamic_cast<const CObservationDVL*>(&o))
		addDvl(*dvl, t);
	else if (const auto* pressure = dynamic_cast<const CObservationPressure*>(&o))
		addPressure(*pressure, t);
	else if (const auto* gps = dynamic_cast<const CObservationGPS*>(&o))
		addGps(*gps, t);
	else if (dynamic_cast<const CObservationStereoImages*>(&o)) {
		TSensorCount& count = m_statistics.sensors[o.sensorLabel];
		if (isLate(t, count)) return;
		predictTo(t, m_rate.rate);
		count.use(t);
	}
}

bool CEkfOdometry::isLate(double t, TSensorCount& count) const
{
	if (!(t < m_stamp)) return false;  // holds before the first stamp too (NaN)
	count.late++;
	return true;
}

void CEkfOdometry::predictTo(double t, const Vector3d& rate)
{
	const double dt = t - m_stamp;
	m_stamp = t;
	if (!m_ready || !(dt > 0)) return;
	m_nav.predict({rate, dt});
	m_edge.predict({rate, dt});
	m_path += m_edge.state().velocity.norm() * dt;
}

void CEkfOdometry::startIfComplete()
{
	if (m_ready || !m_has_rate || !m_initializer.complete()) return;
	const TPoseEstimate start = m_initializer.pose();
	const Matrix3d& R = start.T.linear();
	TNavigationState x;
	x.position = start.T.translation();
	x.R_odom_body = R;
	MatrixMoving cov = MatrixMoving::Zero();
	cov.topLeftCorner<6, 6>() = start.cov;
	cov.topLeftCorner<3, 3>() = R * start.cov.topLeftCorner<3, 3>() * R.transpose();  // odom axes
	cov.diagonal().segment<3>(kVelocity).setConstant(std::pow(m_options.sigma_initial_velocity, 2));
	cov.diagonal().segment<3>(kGyroBias).setConstant(std::pow(m_options.sigma_initial_gyro_bias, 2));
	m_nav.initialize(x, cov);
	m_edge.initialize(x, cov);
	m_edge.anchor(m_nav);
	m_ready = true;
}

bool CEkfOdometry::fuse(const CMeasurement& measurement, bool increments, TSensorCount& count)
{
	if (m_nav.update(measurement)) {
		// One gate decides for both filters: they must have seen the same world.
		if (increments) m_edge.updateUngated(measurement);
	}
	else if (isContradictedForTooLong(measurement, count)) {
		m_nav.giveWay(measurement);
		if (increments) m_edge.giveWay(measurement);
		count.gave_way++;
	}
	else {
		count.gated++;
		count.gated_in_row++;
		return false;
	}
	count.use(m_stamp);
	m_contradictions[&count].count = 0;
	return true;
}

bool CEkfOdometry::isContradictedForTooLong(const CMeasurement& refused, const TSensorCount& count)
{
	TContradiction& c = m_contradictions[&count];
	// Outliers contradict each other too; a filter that is lost sees the same innovation again and again, but
	// for the noise of two readings (chi-square, 3 dof, 99.9 %) or a share for what the vehicle does
	// meanwhile.
	const Vector3d innovation = m_nav.innovation(refused), change = innovation - c.innovation;
	constexpr double kNoise = 2 * 16.3, kShare = 0.25;
	const bool agrees = change.dot(refused.noise().llt().solve(change)) < kNoise ||
						change.norm() < kShare * innovation.norm();
	if (c.count == 0 || !agrees) c = {0, m_stamp, innovation};
	c.count++;
	c.innovation = innovation;
	return m_options.give_way_after > 0 && c.count >= m_options.give_way_after &&
		   m_stamp - c.since >= m_options.give_way_time;
}

void CEkfOdometry::addImu(const CObservationIMU& imu, double t)
{
	const bool is_gyro = m_sensors.imu.count(imu.sensorLabel),
			   is_ahrs = m_sensors.ahrs.count(imu.sensorLabel);
	if (!is_gyro && !is_ahrs)
		throw CError(
			"sensor '" + imu.sensorLabel + "'", "has no entry of kind imu or ahrs in the sensors.ini",
			"add a section [" + imu.sensorLabel + "], or give --assume-defaults");
	TSensorCount& count = m_statistics.sensors[imu.sensorLabel];
	if (isLate(t, count)) return;
	if (is_gyro) addRate(imu, t, count);
	if (is_ahrs) addAttitude(imu, t, count);
}

void CEkfOdometry::addRate(const CObservationIMU& imu, double t, TSensorCount& count)
{
	const auto reading = imuReadingOf(imu);
	if (!reading || !reading->rate.allFinite()) {
		count.invalid++;
		return;
	}
	if (imu.sensorLabel != m_gyro_label) {
		count.idle++;
		return;
	}
	const TImuSpec& spec = m_sensors.imu.begin()->second;
	const Vector3d rate = spec.T_body_sensor().linear() * reading->rate;
	predictTo(t, m_has_rate ? Vector3d(0.5 * (m_rate.rate + rate)) : rate);
	m_rate.rate = rate;
	m_has_rate = true;
	count.use(t);
	startIfComplete();
}

void CEkfOdometry::addAttitude(const CObservationIMU& imu, double t, TSensorCount& count)
{
	const auto R_map_sensor = attitudeOf(imu);
	if (!R_map_sensor || !R_map_sensor->allFinite()) {
		count.invalid++;
		return;
	}
	const TAhrsSpec& spec = specOf(m_sensors.ahrs, imu.sensorLabel);
	TAttitudeMeasurement attitude;
	attitude.R_map_body = *R_map_sensor * spec.T_body_sensor().linear().transpose();
	attitude.sigma_roll_pitch = spec.sigma_roll_pitch;
	attitude.sigma_heading = m_options.use_heading ? spec.sigma_heading : M_PI;	 // not known
	predictTo(t, m_rate.rate);
	if (!m_ready) {
		count.idle++;
		attitude.sigma_heading = spec.sigma_heading;  // the start needs some heading
		m_initializer.addAttitude(attitude);
		startIfComplete();
		return;
	}
	const bool accepted =
		m_options.use_heading
			? fuse(
				  CAttitudeMeasurement(
					  attitude.R_map_body, attitude.sigma_roll_pitch, attitude.sigma_heading),
				  false, count)
			: fuse(CGravityMeasurement(attitude.R_map_body, attitude.sigma_roll_pitch), false, count);
	if (!accepted) return;
	static_cast<TReading&>(m_last_attitude) = reading(t);
	m_last_attitude.attitude = attitude;
}

void CEkfOdometry::addDvl(const CObservationDVL& dvl, double t)
{
	const TDvlSpec& spec = specOf(m_sensors.dvl, dvl.sensorLabel);
	TSensorCount& count = m_statistics.sensors[dvl.sensorLabel];
	if (isLate(t, count)) return;
	predictTo(t, m_rate.rate);
	if (!isValid(dvl, m_options.max_dvl_speed))
		count.invalid++;
	else if (!m_ready)
		count.idle++;
	else
		fuse(
			CDvlMeasurement(
				{dvl.velocity.x, dvl.velocity.y, dvl.velocity.z}, velocityCovariance(dvl, spec),
				spec.T_body_sensor(), m_rate),
			true, count);
}

void CEkfOdometry::addPressure(const CObservationPressure& pressure, double t)
{
	const TPressureSpec& spec = specOf(m_sensors.pressure, pressure.sensorLabel);
	TSensorCount& count = m_statistics.sensors[pressure.sensorLabel];
	if (isLate(t, count)) return;
	predictTo(t, m_rate.rate);
	const double depth = spec.depth(pressure.pressure), sigma = spec.sigmaDepth();
	const Vector3d lever = spec.T_body_sensor().translation();
	if (!std::isfinite(depth))
		count.invalid++;
	else if (!m_ready) {
		count.idle++;
		m_initializer.addDepth(depth, sigma, lever);
		startIfComplete();
	}
	else if (fuse(CDepthMeasurement(depth, sigma, lever), true, count)) {
		static_cast<TReading&>(m_last_depth) = reading(t);
		m_last_depth.body_depth.value = depth - m_last_depth.R_map_body.row(2).dot(lever);
		m_last_depth.body_depth.sigma = std::sqrt(sigma * sigma + leverVariance(lever).z());
	}
}

void CEkfOdometry::addGps(const CObservationGPS& gps, double t)
{
	const TGpsSpec& spec = specOf(m_sensors.gps, gps.sensorLabel);
	TSensorCount& count = m_statistics.sensors[gps.sensorLabel];
	if (isLate(t, count)) return;
	predictTo(t, m_rate.rate);
	const auto fix = fixOf(gps);
	const Vector3d lever = spec.T_body_sensor().translation();
	if (!fix) {
		count.invalid++;
		return;
	}
	const Vector2d north_east = nedFromGeodetic(*fix, m_datum).head<2>();
	if (!m_ready) {
		count.idle++;
		m_initializer.addFix(t, north_east, spec.sigma_horizontal, lever);
		startIfComplete();
	}
	else if (!m_options.use_gps)
		count.idle++;
	else if (fuse(CHorizontalMeasurement(north_east, spec.sigma_horizontal, lever), false, count)) {
		static_cast<TReading&>(m_last_fix) = reading(t);
		m_last_fix.body_position.value = north_east - (m_last_fix.R_map_body * lever).head<2>();
		m_last_fix.body_position.sigma = std::sqrt(
			spec.sigma_horizontal * spec.sigma_horizontal + leverVariance(lever).head<2>().maxCoeff());
	}
}

Vector3d CEkfOdometry::leverVariance(const Vector3d& lever) const
{
	const Matrix3d G = m_nav.state().R_odom_body * skew(lever);
	return (G * m_nav.covariance().block<3, 3>(kAttitude, kAttitude) * G.transpose()).diagonal();
}

Isometry3d CEkfOdometry::T_dr_body() const
{
	return m_T_dr_clone * displacement(m_edge.state());
}

CEkfOdometry::TReading CEkfOdometry::reading(double t) const
{
	return {t, T_dr_body(), m_nav.state().R_odom_body};
}

void CEkfOdometry::clone()
{
	m_T_dr_clone = orthonormalized(T_dr_body());
	m_nav.clone();
	m_edge.anchor(m_nav);
	m_path_at_clone = m_path;
	if (m_stamp > m_clone_stamp) m_previous_clone_stamp = m_clone_stamp;
	m_clone_stamp = m_stamp;
}

TPoseEstimate CEkfOdometry::sinceClone() const
{
	TPoseEstimate estimate = m_edge.sinceClone();
	estimate.path_length = m_path - m_path_at_clone;
	return estimate;
}

TPoseEstimate CEkfOdometry::now() const
{
	TPoseEstimate estimate = m_nav.pose();
	estimate.path_length = m_path;
	return estimate;
}

/** Young enough, and not handed to an earlier node: clone() may be called before or after unary(). */
bool CEkfOdometry::isFresh(const TReading& r) const
{
	const double earlier_node = m_clone_stamp == m_stamp ? m_previous_clone_stamp : m_clone_stamp;
	return r.stamp > earlier_node && m_stamp - r.stamp <= m_options.unary_max_age;
}

TUnaryMeasurements CEkfOdometry::unary() const
{
	TUnaryMeasurements u;
	const auto sinceReading = [&](const TReading& r) {
		return Isometry3d(r.T_dr_body.inverse() * T_dr_body());
	};
	if (isFresh(m_last_depth)) {
		u.depth = m_last_depth.body_depth;
		u.depth->value += m_last_depth.R_map_body.row(2).dot(sinceReading(m_last_depth).translation());
	}
	if (isFresh(m_last_attitude)) {
		u.attitude = m_last_attitude.attitude;
		u.attitude->R_map_body *= sinceReading(m_last_attitude).linear();
	}
	if (isFresh(m_last_fix)) {
		u.position = m_last_fix.body_position;
		u.position->value += (m_last_fix.R_map_body * sinceReading(m_last_fix).translation()).head<2>();
	}
	return u;
}
}  // namespace posidonia
