#include <posidonia/base/error.h>
#include <posidonia/nav/cola2_odometry.h>

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
EIteration iterationOf(const TEkfOptions& options)
{
	return options.cola2_iteration == "stock" ? EIteration::STOCK : EIteration::OWN;
}
}  // namespace

CCola2Odometry::CCola2Odometry(
	const TEkfOptions& options, const TInitialPoseOptions& start, const TSensorSuite& sensors,
	const TWorldOptions& datum)
	: m_setup(std::make_shared<const TNavigatorSetup>(options, TDragOptions{}, start, sensors, datum)),
	  m_decoder(m_setup),
	  m_nav(options.acceleration_density, options.gate_probability, iterationOf(options)),
	  m_edge(options.acceleration_density, options.gate_probability, iterationOf(options)),
	  m_initializer(start),
	  m_counts(m_setup->sensor.size())
{
	if (sensors.ahrs.empty())
		throw CError(
			"sensors", "there is no AHRS (kind ahrs), whose attitude [Ekf] mode = cola2 takes",
			"add a section with kind = ahrs to the sensors.ini, or set mode = ins");
}

void CCola2Odometry::add(const mrpt::obs::CObservation& observation)
{
	m_decoder.decode(observation, [this](const TSensorReading& reading) { take(reading); });
}

void CCola2Odometry::take(const TSensorReading& reading)
{
	if (reading.sensor < 0) return;
	if (reading.stamp < m_stamp) {
		countOf(reading).late++;
		return;
	}
	std::visit([&](const auto& what) { apply(reading, what); }, reading.what);
}

void CCola2Odometry::predictTo(double t)
{
	const double dt = t - m_stamp;
	m_stamp = t;
	if (!m_ready || !(dt > 0)) return;
	m_nav.predict(m_R_map_body, dt);
	m_edge.predict(m_R_map_body, dt);
	m_path += motion().velocity.norm() * dt;
}

void CCola2Odometry::startIfComplete()
{
	if (m_ready || !m_has_attitude || !m_initializer.complete()) return;
	const TPoseEstimate start = m_initializer.pose();
	const Matrix3d& R = start.T.linear();
	CCola2EKF::Vector6 x = CCola2EKF::Vector6::Zero();
	x.head<3>() = start.T.translation();
	CCola2EKF::Matrix6 P = CCola2EKF::Matrix6::Zero();
	P.topLeftCorner<3, 3>() = R * start.cov.topLeftCorner<3, 3>() * R.transpose();
	P.bottomRightCorner<3, 3>().diagonal().setConstant(std::pow(m_setup->options.sigma_initial_velocity, 2));
	m_nav.initialize(x, P);
	m_edge.initialize(x, P);
	m_ready = true;
	clone();
}

void CCola2Odometry::fuse(
	const TCola2Measurement& measurement, bool increments, const TSensorReading& reading)
{
	if (!m_nav.update(measurement)) {
		countOf(reading).gated++;
		countOf(reading).gated_in_row++;
		return;
	}
	if (increments) m_edge.updateUngated(measurement);
	countOf(reading).use(m_stamp, specOf(reading).time_out);
}

void CCola2Odometry::apply(const TSensorReading& reading, const TTick&)
{
	predictTo(reading.stamp);
	countOf(reading).use(m_stamp, 0);
}

void CCola2Odometry::apply(const TSensorReading& reading, const TInertialReading& imu)
{
	predictTo(reading.stamp);
	m_rate = imu.rate;
	countOf(reading).use(m_stamp, specOf(reading).time_out);
}

void CCola2Odometry::apply(const TSensorReading& reading, const TAttitudeReading& attitude)
{
	predictTo(reading.stamp);
	m_R_map_body = attitude.R_map_body;
	m_has_attitude = true;
	const TAhrsSpec& spec = *specOf(reading).ahrs;
	if (!m_ready) m_initializer.addAttitude({attitude.R_map_body, spec.sigma_roll_pitch, spec.sigma_heading});
	countOf(reading).use(m_stamp, specOf(reading).time_out);
	startIfComplete();
}

void CCola2Odometry::apply(const TSensorReading& reading, const TDvlReading& dvl)
{
	predictTo(reading.stamp);
	if (!m_ready || !dvl.has_velocity) {
		countOf(reading).idle++;
		return;
	}
	const TDvlMount& mount = specOf(reading).dvl_mount;
	TCola2Measurement m;
	m.z = dvl.velocity;
	m.H.rightCols<3>() = mount.R_dvl_body;
	m.offset = mount.R_dvl_body * m_rate.cross(mount.lever);
	m.noise = dvl.cov;
	fuse(m, true, reading);
}

TCola2Measurement CCola2Odometry::positionOf(
	const Vector3d& z, int first, int rows, double sigma, const Vector3d& lever) const
{
	TCola2Measurement m;
	m.rows = rows;
	const Vector3d arm = m_R_map_body * lever;
	for (int i = 0; i < rows; i++) {
		m.z[i] = z[first + i];
		m.offset[i] = arm[first + i];
		m.H(i, first + i) = 1;
		m.noise(i, i) = sigma * sigma;
	}
	return m;
}

void CCola2Odometry::apply(const TSensorReading& reading, const TDepthReading& depth)
{
	predictTo(reading.stamp);
	const double sigma = specOf(reading).pressure->sigmaDepth();
	const Vector3d& lever = specOf(reading).lever;
	if (m_ready) {
		fuse(positionOf({0, 0, depth.depth}, 2, 1, sigma, lever), false, reading);
		return;
	}
	countOf(reading).idle++;
	m_initializer.addDepth(depth.depth, sigma, lever);
	startIfComplete();
}

void CCola2Odometry::apply(const TSensorReading& reading, const TFixReading& fix)
{
	predictTo(reading.stamp);
	const double sigma = specOf(reading).gps->sigma_horizontal;
	const Vector3d& lever = specOf(reading).lever;
	if (m_ready && m_setup->options.use_gps) {
		fuse(positionOf({fix.north_east.x(), fix.north_east.y(), 0}, 0, 2, sigma, lever), false, reading);
		return;
	}
	countOf(reading).idle++;
	if (m_ready) return;
	m_initializer.addFix(reading.stamp, fix.north_east, sigma, lever);
	startIfComplete();
}

void CCola2Odometry::clone()
{
	m_edge.anchor();
	m_R_map_clone = m_R_map_body;
	m_path_at_clone = m_path;
}

Matrix3d CCola2Odometry::attitudeCovariance(const Matrix3d& R) const
{
	const TAhrsSpec& spec = m_setup->sensors.ahrs.begin()->second;
	return attitudeNoise(R, spec.sigma_roll_pitch, spec.sigma_heading);
}

TPoseEstimate CCola2Odometry::sinceClone() const
{
	TPoseEstimate edge;
	edge.T.linear() = m_R_map_clone.transpose() * m_R_map_body;
	edge.T.translation() = m_R_map_clone.transpose() * m_edge.state().head<3>();
	const Matrix3d R_now_map = m_R_map_body.transpose(), R_now_clone = edge.T.linear().transpose();
	edge.cov.topLeftCorner<3, 3>() = R_now_map * m_edge.covariance().topLeftCorner<3, 3>() * m_R_map_body;
	edge.cov.bottomRightCorner<3, 3>() = attitudeCovariance(m_R_map_body);
	Eigen::Matrix<double, 6, 3> by_clone;  // an error of the clone's attitude turns the whole edge
	by_clone << R_now_clone * skew(edge.T.translation()), -R_now_clone;
	edge.cov += by_clone * attitudeCovariance(m_R_map_clone) * by_clone.transpose();
	edge.path_length = m_path - m_path_at_clone;
	return edge;
}

TPoseEstimate CCola2Odometry::now() const
{
	TPoseEstimate pose;
	pose.T.linear() = m_R_map_body;
	pose.T.translation() = m_nav.state().head<3>();
	pose.cov.topLeftCorner<3, 3>() =
		m_R_map_body.transpose() * m_nav.covariance().topLeftCorner<3, 3>() * m_R_map_body;
	pose.cov.bottomRightCorner<3, 3>() = attitudeCovariance(m_R_map_body);
	pose.path_length = m_path;
	return pose;
}

TNavStatistics CCola2Odometry::statistics() const
{
	TNavStatistics s;
	for (size_t i = 0; i < m_counts.size(); i++)
		s.sensors[m_setup->sensor[i].label] = m_counts[i].plus(m_decoder.count(static_cast<int>(i)));
	return s;
}
}  // namespace posidonia
