#include <mrpt/core/format.h>
#include <posidonia/base/error.h>
#include <posidonia/nav/navigator.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
/** The filter starts at the first fix and takes the others as any, so it may move meanwhile. */
TInitialPoseOptions fromOneFix(TInitialPoseOptions start)
{
	start.gps_fixes = 1;
	return start;
}
}  // namespace

CNavigator::TMemory::TMemory(const TNavigatorSetup& setup)
	: sensors(setup.sensor.size()),
	  initializer(fromOneFix(setup.start), setup.origin),
	  drag(setup.drag),
	  rest(
		  setup.driving_imu < 0 ? 0 : std::sqrt(setup.rate_variance),
		  setup.driving_imu < 0 ? 0 : setup.noise.accel * std::sqrt(setup.sensors.imu.begin()->second.rate))
{
}

CNavigator::CNavigator(std::shared_ptr<const TNavigatorSetup> setup)
	: m_setup(std::move(setup)),
	  m_nav(m_setup->noise, m_setup->options.gate_probability),
	  m_edge(m_setup->noise, m_setup->options.gate_probability),
	  m(*m_setup)
{
}

CNavigator::CSnapshot::CSnapshot(const CNavigator& from) : m(from.m)
{
	from.m_nav.save(nav);
	from.m_edge.save(edge);
}

void CNavigator::save(CSnapshot& to) const
{
	to.m = m;
	m_nav.save(to.nav);
	if (m_with_edges) m_edge.save(to.edge);
}

void CNavigator::restore(const CSnapshot& from)
{
	m = from.m;
	m_nav.restore(from.nav);
	m_edge.restore(from.edge);
}

void CNavigator::apply(const TSensorReading& reading)
{
	m.innovation = {};
	std::visit([&](const auto& what) { apply(reading, what); }, reading.what);
}

void CNavigator::resetClock(double stamp)
{
	const double by = stamp - m.stamp;
	for (double* t :
		 {&m.stamp, &m.imu_stamp, &m.clone_stamp, &m.previous_clone_stamp, &m.velocity_stamp,
		  &m.unconfirmed_stamp, &m.drag_stamp, &m.depth.stamp, &m.attitude.stamp, &m.fix.stamp})
		*t += by;
	for (TSensorMemory& sensor : m.sensors) {
		sensor.count.last_used += by;
		sensor.contradiction = {};
	}
}

void CNavigator::predictTo(double t, const TInertialReading& imu)
{
	const double from = m.stamp;
	m.stamp = t;
	if (!m.started || !(t > from)) return;
	const bool silent = t - m.imu_stamp > m_setup->options.imu_time_out;
	const EDrive drive = silent ? EDrive::KINEMATIC : m_setup->drive;
	// Derivatives hold for small turns; a silence is walked in steps.
	constexpr double kLongest = 0.25;
	const int steps = std::max(1, static_cast<int>(std::ceil((t - from) / kLongest)));
	for (int i = 0; i < steps; i++)
		predict({drive, imu.rate, imu.force, (t - from) / steps});
	bridgeLossOfLock();
}

void CNavigator::predict(const TMotionInput& u)
{
	m_nav.predict(u);
	if (m_with_edges) m_edge.predict(u);
	m.path += velocity().norm() * u.dt;
}

namespace
{
/** A start that was measured carries the sensors' lasting errors: attitude -ahrs_bias, depth
 * -pressure_offset, north and east -gps_bias. */
void correlateStart(MatrixMoving& cov, const Matrix3d& R, const Vector3d& origin)
{
	constexpr int kBiases = 6, kFirst = kPressureOffset;
	Eigen::Matrix<double, 6, kBiases> A = Eigen::Matrix<double, 6, kBiases>::Zero();
	A.block<3, 3>(kAttitude, kAhrsBias - kFirst) = -R.transpose();
	A.topRows<3>() =
		R * skew(origin) * A.bottomRows<3>();  // the navigated point turns about the body's origin
	A(2, 0) = -1;
	A.block<2, 2>(0, kGpsBias - kFirst) = -Eigen::Matrix2d::Identity();
	const Eigen::Matrix<double, 6, kBiases> cross = A * cov.block<kBiases, kBiases>(kFirst, kFirst);
	cov.topLeftCorner<6, 6>() += cross * A.transpose();
	cov.block<6, kBiases>(0, kFirst) = cross;
	cov.block<kBiases, 6>(kFirst, 0) = cross.transpose();
}
}  // namespace

void CNavigator::startIfComplete()
{
	if (m.started || !m.initializer.complete()) return;
	if (m_setup->driving_imu >= 0 && !m.has_rate) return;
	const TEkfOptions& o = m_setup->options;
	const TPoseEstimate start = m.initializer.pose();
	TNavigationState x;
	x.R_odom_body = start.T.linear();
	x.position = start.T * Vector3d(-m_setup->origin);	// of the navigated point
	const Isometry3d T_body_nav = m_setup->T_nav_body().inverse();
	Matrix6d pose = changeFrameCovariance(start.cov, T_body_nav);
	Matrix6d J = Matrix6d::Identity();	// own axes to odom's
	J.topLeftCorner<3, 3>() = x.R_odom_body;
	MatrixMoving cov = MatrixMoving::Zero();
	cov.topLeftCorner<6, 6>() = J * pose * J.transpose();
	auto variance = cov.diagonal();
	variance.segment<3>(kVelocity).setConstant(std::pow(o.sigma_initial_velocity, 2));
	variance.segment<3>(kGyroBias).setConstant(std::pow(o.sigma_initial_gyro_bias, 2));
	variance.segment<3>(kAccelBias).setConstant(std::pow(o.sigma_initial_accel_bias, 2));
	variance.segment<7>(kDvlScale) = m_setup->startVariance();
	if (!m_setup->start.known) correlateStart(cov, x.R_odom_body, m_setup->origin);
	m_nav.initialize(x, cov);
	m_edge.initialize(x, cov);
	m.started = true;
	m.fixes = 1;
	m.fix_stamp = m.stamp;
	if (m_setup->start.known || m.fixes >= m_setup->start.gps_fixes) becomeReady();
}

void CNavigator::countFix()
{
	if (m.ready) return;
	const bool gap = m.stamp - m.fix_stamp > m_setup->start.gps_max_gap;
	m.fix_stamp = m.stamp;
	if (gap) {
		m.started = false;
		m.initializer = CPoseInitializer(fromOneFix(m_setup->start), m_setup->origin);
	}
	else if (++m.fixes >= m_setup->start.gps_fixes)
		becomeReady();
}

void CNavigator::becomeReady()
{
	m.ready = true;
	m.path = 0;
	m_nav.clone();
	m_edge.anchor(m_nav);
}

void CNavigator::clone()
{
	m.T_dr_clone = orthonormalized(T_dr_body());
	m_nav.clone();
	m_edge.anchor(m_nav);
	m.path_at_clone = m.path;
	if (m.stamp > m.clone_stamp) m.previous_clone_stamp = m.clone_stamp;
	m.clone_stamp = m.stamp;
}

bool CNavigator::fuse(const CMeasurement& measurement, bool increments, int sensor)
{
	TSensorMemory& memory = m.sensors[static_cast<size_t>(sensor)];
	increments = increments && m_with_edges;
	const bool accepted = m_nav.update(measurement);
	m.innovation = {sensor, m_nav.lastDistance(), measurement.degreesOfFreedom(), accepted};
	if (accepted) {
		// One gate decides for both filters: they must have seen the same world.
		if (increments) m_edge.updateUngated(measurement);
	}
	else if (isContradictedForTooLong(measurement, memory.contradiction)) {
		m_nav.giveWay(measurement);
		if (increments) m_edge.giveWay(measurement);
		memory.count.gave_way++;
	}
	else {
		memory.count.gated++;
		memory.count.gated_in_row++;
		return false;
	}
	memory.count.use(m.stamp, m_setup->sensor[static_cast<size_t>(sensor)].time_out);
	memory.contradiction.count = 0;
	return true;
}

bool CNavigator::isContradictedForTooLong(const CMeasurement& refused, TContradiction& c)
{
	// Outliers contradict each other too; a filter that is lost sees the same innovation again and again, but
	// for the noise of two readings (chi-square, 3 dof, 99.9 %) or a share for what the vehicle does
	// meanwhile.
	const CMeasurement::Value innovation = m_nav.innovation(refused), change = innovation - c.innovation;
	constexpr double kNoise = 2 * 16.3, kShare = 0.25;
	const bool agrees = change.dot(refused.noise().llt().solve(change)) < kNoise ||
						change.norm() < kShare * innovation.norm();
	if (c.count == 0 || !agrees) c = {0, m.stamp, innovation};
	c.count++;
	c.innovation = innovation;
	const TEkfOptions& o = m_setup->options;
	return o.give_way_after > 0 && c.count >= o.give_way_after && m.stamp - c.since >= o.give_way_time;
}

TBodyRate CNavigator::bodyRate() const
{
	return {m.imu.rate, m_setup->rate_variance};
}

Vector3d CNavigator::velocity() const
{
	return m_nav.state().trueVelocity() + rate().cross(m_setup->origin);
}

Vector3d CNavigator::rate() const
{
	return m.imu.rate - m_nav.state().gyro_bias;
}

Isometry3d CNavigator::T_dr_body() const
{
	const Isometry3d T_nav_body = m_setup->T_nav_body();
	return m.T_dr_clone * (T_nav_body.inverse() * displacement(m_edge.state()) * T_nav_body);
}

namespace
{
/** The estimate of T as one of X T Y, X and Y exact. */
TPoseEstimate moved(const Isometry3d& X, TPoseEstimate estimate, const Isometry3d& Y)
{
	estimate.T = X * estimate.T * Y;
	estimate.cov = changeFrameCovariance(estimate.cov, Y);
	return estimate;
}
}  // namespace

TPoseEstimate CNavigator::now() const
{
	TPoseEstimate estimate = moved(Isometry3d::Identity(), m_nav.pose(), m_setup->T_nav_body());
	estimate.path_length = m.path;
	if (!estimate.T.matrix().allFinite())
		throw CError(
			"navigation filter", mrpt::format("its pose is no number any more (stamp %.2f)", stamp()),
			"check axes, signs and units of the sensors: an AHRS or IMU that is upside down does this");
	return estimate;
}

TPoseEstimate CNavigator::sinceClone() const
{
	const Isometry3d T_nav_body = m_setup->T_nav_body();
	TPoseEstimate estimate = moved(T_nav_body.inverse(), m_edge.sinceClone(), T_nav_body);
	estimate.path_length = m.path - m.path_at_clone;
	return estimate;
}
}  // namespace posidonia
