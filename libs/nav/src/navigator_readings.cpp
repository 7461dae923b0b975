#include <posidonia/nav/navigator.h>

/** What each kind of reading does to the filters. */
namespace posidonia
{
namespace
{
constexpr double kDive = 3600;	///< [s]
}

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

void CNavigator::apply(const TSensorReading& reading, const TTick&)
{
	predictTo(reading.stamp, m.imu);
	if (reading.sensor >= 0) use(reading);
}

void CNavigator::apply(const TSensorReading& reading, const TCloneMark&)
{
	predictTo(reading.stamp, m.imu);
	clone();
}

void CNavigator::apply(const TSensorReading& reading, const TInertialReading& imu)
{
	if (reading.sensor != m_setup->driving_imu) {
		countOf(reading).idle++;
		return;
	}
	const TInertialReading mean{0.5 * (m.imu.rate + imu.rate), 0.5 * (m.imu.force + imu.force)};
	predictTo(reading.stamp, m.has_rate ? mean : imu);
	m.imu = imu;
	m.imu_stamp = reading.stamp;
	m.has_rate = true;
	use(reading);
	startIfComplete();
	if (m.started) restIfStill(reading);
}

void CNavigator::apply(const TSensorReading& reading, const TAttitudeReading& attitude)
{
	predictTo(reading.stamp, m.imu);
	const TAhrsSpec& spec = *specOf(reading).ahrs;
	if (m.started) {
		fuseAttitude(reading, attitude);
		return;
	}
	countOf(reading).idle++;
	m.initializer.addAttitude({attitude.R_map_body, spec.sigma_roll_pitch, spec.sigma_heading});
	startIfComplete();
}

bool CNavigator::fuseAttitude(const TSensorReading& reading, const TAttitudeReading& attitude)
{
	const TAhrsSpec& spec = *specOf(reading).ahrs;
	const bool use_heading = m_setup->options.use_heading;
	const bool accepted =
		use_heading
			? fuse(
				  CAttitudeMeasurement(attitude.R_map_body, spec.sigma_roll_pitch, spec.sigma_heading), false,
				  reading.sensor)
			: fuse(CGravityMeasurement(attitude.R_map_body, spec.sigma_roll_pitch), false, reading.sensor);
	if (!accepted) return false;
	keep(m.attitude);
	TAttitudeMeasurement& kept = m.attitude.attitude;
	kept.R_map_body = expSO3(-m_nav.state().ahrs_bias) * attitude.R_map_body;
	kept.sigma_roll_pitch = std::sqrt(std::pow(spec.sigma_roll_pitch, 2) + variance(kAhrsBias));
	kept.sigma_heading =
		use_heading ? std::sqrt(std::pow(spec.sigma_heading, 2) + variance(kAhrsBias + 2)) : M_PI;
	kept.lasting_roll_pitch = std::sqrt(variance(kAhrsBias));
	kept.lasting_heading = use_heading ? std::sqrt(variance(kAhrsBias + 2)) : M_PI;
	kept.lasting_time = spec.bias_time;
	return true;
}

CDvlMeasurement CNavigator::dvlMeasurement(
	const TNavigatorSetup::TSensor& sensor, const TDvlReading& dvl) const
{
	const bool as_beams = m_setup->options.dvl == "beams" || !dvl.has_velocity;
	return as_beams ? CDvlMeasurement::beams(
						  dvl.beams, sensor.dvl->sigmaBeam(), sensor.dvl_beams, sensor.dvl_mount, bodyRate())
					: CDvlMeasurement::axes(dvl.velocity, dvl.cov, sensor.dvl_mount, bodyRate());
}

bool CNavigator::beamsContradict(const TNavigatorSetup::TSensor& sensor, const TDvlReading& dvl) const
{
	if (dvl.beams.hasNaN()) return false;
	// Opposite beams of a Janus head see the same vertical: what is left is the error velocity.
	const double error = dvl.beams[0] - dvl.beams[1] + dvl.beams[2] - dvl.beams[3];
	const double variance = 4 * std::pow(sensor.dvl->sigmaBeam(), 2);
	return error * error > m_nav.gate(1) * variance;
}

bool CNavigator::isConfirmed(const TDvlReading& dvl)
{
	const double silence = m_setup->options.dvl_time_out;
	if (m.stamp - m.velocity_stamp <= silence || !dvl.has_velocity) return true;
	// What a vehicle may do between two pings, and their noise.
	constexpr double kAcceleration = 0.5, kSigmas = 5;
	const double since = m.stamp - m.unconfirmed_stamp,
				 allowed = kAcceleration * since + kSigmas * std::sqrt(2 * dvl.cov.trace());
	const bool agrees = since <= silence && (dvl.velocity - m.unconfirmed).norm() <= allowed;
	m.unconfirmed = dvl.velocity;
	m.unconfirmed_stamp = m.stamp;
	return agrees;
}

void CNavigator::apply(const TSensorReading& reading, const TDvlReading& dvl)
{
	predictTo(reading.stamp, m.imu);
	const TNavigatorSetup::TSensor& sensor = specOf(reading);
	if (!m.started)
		countOf(reading).idle++;
	else if (beamsContradict(sensor, dvl))
		countOf(reading).inconsistent++;
	else if (!isConfirmed(dvl))
		countOf(reading).gated++;
	else if (fuse(dvlMeasurement(sensor, dvl), true, reading.sensor)) {
		m.velocity_stamp = m.stamp;
		m.dragging = false;
	}
}

void CNavigator::apply(const TSensorReading& reading, const TDepthReading& depth)
{
	predictTo(reading.stamp, m.imu);
	const TNavigatorSetup::TSensor& sensor = specOf(reading);
	const double sigma = sensor.pressure->sigmaDepth();
	if (!m.started) {
		countOf(reading).idle++;
		m.initializer.addDepth(depth.depth, sigma, sensor.lever);
		startIfComplete();
		return;
	}
	if (!fuse(CDepthMeasurement(depth.depth, sigma, sensor.lever), true, reading.sensor)) return;
	keep(m.depth);
	const Vector3d from_body = sensor.lever - m_setup->origin;
	m.depth.body_depth.value =
		depth.depth - m_nav.state().pressure_offset - m.depth.R_map_body.row(2).dot(from_body);
	m.depth.body_depth.sigma =
		std::sqrt(sigma * sigma + variance(kPressureOffset) + leverVariance(from_body).z());
	// A wrong surface pressure stays for the dive.
	m.depth.body_depth.lasting = std::sqrt(variance(kPressureOffset));
	m.depth.body_depth.lasting_time = kDive;
}

void CNavigator::apply(const TSensorReading& reading, const TFixReading& fix)
{
	predictTo(reading.stamp, m.imu);
	const TNavigatorSetup::TSensor& sensor = specOf(reading);
	const double sigma = sensor.gps->sigma_horizontal;
	if (!m.started) {
		countOf(reading).idle++;
		m.initializer.addFix(reading.stamp, fix.north_east, sigma, sensor.lever);
		startIfComplete();
		return;
	}
	if (!m_setup->options.use_gps && m.ready) {
		countOf(reading).idle++;
		return;
	}
	const double depth = now().T.translation().z(), sure = 3 * std::sqrt(variance(kPosition + 2));
	if (depth - sure > m_setup->options.gps_max_depth) {
		countOf(reading).invalid++;
		return;
	}
	if (!fuse(CHorizontalMeasurement(fix.north_east, sigma, sensor.lever), false, reading.sensor)) return;
	countFix();
	keep(m.fix);
	const Vector3d from_body = sensor.lever - m_setup->origin;
	m.fix.body_position.value =
		fix.north_east - m_nav.state().gps_bias - (m.fix.R_map_body * from_body).head<2>();
	m.fix.body_position.sigma = std::sqrt(
		sigma * sigma + std::max(variance(kGpsBias), variance(kGpsBias + 1)) +
		leverVariance(from_body).head<2>().maxCoeff());
	m.fix.body_position.lasting = std::sqrt(std::max(variance(kGpsBias), variance(kGpsBias + 1)));
	m.fix.body_position.lasting_time = sensor.gps->bias_time;
}

void CNavigator::bridgeLossOfLock()
{
	constexpr double kPeriod = 1;												// [s]
	if (!(m.stamp - m.velocity_stamp > m_setup->options.dvl_time_out)) return;	// or never had lock
	if (!m.dragging) {
		m.dragging = true;
		m.drag.start(velocity());
		m.drag_time += m.stamp - m.velocity_stamp;
		m.drag_stamp = m.stamp;
		return;
	}
	if (m.stamp - m.drag_stamp < kPeriod) return;
	const double dt = m.stamp - m.drag_stamp;
	m.drag.advance(dt);
	m.drag_stamp = m.stamp;
	m.drag_time += dt;
	const CBodyVelocityMeasurement expected(
		m.drag.velocity(), m.drag.sigmaOfReading(dt), m_setup->origin, bodyRate());
	m_nav.updateUngated(expected);
	if (m_with_edges) m_edge.updateUngated(expected);
}

void CNavigator::restIfStill(const TSensorReading& reading)
{
	if (!m_setup->options.zero_velocity || !m.rest.add(reading.stamp, m.imu.rate, m.imu.force)) return;
	constexpr double kSigma = 0.01;	 // [m/s]
	const CBodyVelocityMeasurement rest(
		Vector3d::Zero(), Vector3d::Constant(kSigma), m_setup->origin, bodyRate());
	if (m_nav.update(rest) && m_with_edges) m_edge.updateUngated(rest);
}

double CNavigator::variance(int row) const
{
	return m_nav.variance(row);
}

Vector3d CNavigator::leverVariance(const Vector3d& lever) const
{
	const Matrix3d G = m_nav.state().R_odom_body * skew(lever);
	return (G * m_nav.covariance().block<3, 3>(kAttitude, kAttitude) * G.transpose()).diagonal();
}

void CNavigator::keep(TKept& kept) const
{
	kept = {m.stamp, T_dr_body(), m_nav.state().R_odom_body};
}

/** Young enough, and not handed to an earlier node: clone() may be called before or after unary(). */
bool CNavigator::isFresh(const TKept& kept) const
{
	const double earlier_node = m.clone_stamp == m.stamp ? m.previous_clone_stamp : m.clone_stamp;
	return kept.stamp > earlier_node && m.stamp - kept.stamp <= m_setup->options.unary_max_age;
}

TUnaryMeasurements CNavigator::unary() const
{
	TUnaryMeasurements u;
	const auto since = [&](const TKept& kept) { return Isometry3d(kept.T_dr_body.inverse() * T_dr_body()); };
	if (isFresh(m.depth)) {
		u.depth = m.depth.body_depth;
		u.depth->value += m.depth.R_map_body.row(2).dot(since(m.depth).translation());
	}
	if (isFresh(m.attitude)) {
		u.attitude = m.attitude.attitude;
		u.attitude->R_map_body *= since(m.attitude).linear();
	}
	if (isFresh(m.fix)) {
		u.position = m.fix.body_position;
		u.position->value += (m.fix.R_map_body * since(m.fix).translation()).head<2>();
	}
	return u;
}
}  // namespace posidonia
