#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/nav/recorded_odometry.h>
#include <posidonia/obs/observations.h>

#include <algorithm>

namespace posidonia
{
using Eigen::Isometry3d;
using namespace mrpt::obs;

namespace
{
constexpr size_t kHistory = 256;  ///< Poses kept: a pair may arrive after poses with later stamps

/** T_a at s = 0, T_b at s = 1; straight in translation, constant rate in rotation; s > 1 extrapolates. */
Isometry3d interpolated(const Isometry3d& T_a, const Isometry3d& T_b, double s)
{
	Isometry3d T = Isometry3d::Identity();
	T.translation() = T_a.translation() + s * (T_b.translation() - T_a.translation());
	T.linear() = T_a.linear() * expSO3(s * logSO3(T_a.linear().transpose() * T_b.linear()));
	return T;
}
}  // namespace

CRecordedOdometry::CRecordedOdometry(const TRecordedOdometryOptions& options) : m_options(options) {}

void CRecordedOdometry::add(const CObservation& o)
{
	if (const auto* robot_pose = dynamic_cast<const CObservationRobotPose*>(&o)) {
		if (o.sensorLabel == m_options.label)
			addPose(stampOf(o), fromMrpt(robot_pose->pose.mean), localCovariance(robot_pose->pose));
	}
	else if (dynamic_cast<const CObservationStereoImages*>(&o) && ready())
		moveTo(stampOf(o));
}

void CRecordedOdometry::addPose(double t, const Isometry3d& T, const Matrix6d& cov)
{
	if (!m_history.empty() && !(t > m_history.back().stamp)) {
		m_late++;
		return;
	}
	const double step =
		m_history.empty() ? 0 : (T.translation() - m_history.back().T_odom_body.translation()).norm();
	m_history.push_back({t, T, cov, m_history.empty() ? 0 : m_history.back().path + step});
	if (m_history.size() > kHistory) m_history.pop_front();
	m_stamp = t;
	m_now = m_history.back();
	if (!m_started) m_clone = m_now;
	m_started = true;
}

void CRecordedOdometry::moveTo(double t)
{
	if (t < m_history.front().stamp || t < m_clone.stamp) {
		m_late++;
		return;
	}
	if (t > m_history.back().stamp + m_options.max_extrapolation) m_stale++;
	m_stamp = t;
	m_now = at(t);
}

CRecordedOdometry::TRecord CRecordedOdometry::at(double t) const
{
	if (m_history.size() < 2)
		return {t, m_history.back().T_odom_body, m_history.back().cov, m_history.back().path};
	t = std::min(t, m_history.back().stamp + m_options.max_extrapolation);
	const auto later = std::find_if(
		std::next(m_history.begin()), std::prev(m_history.end()),
		[&](const TRecord& r) { return r.stamp >= t; });
	const TRecord &a = *std::prev(later), &b = *later;
	const double s = (t - a.stamp) / (b.stamp - a.stamp);
	return {
		m_stamp, interpolated(a.T_odom_body, b.T_odom_body, s), s < 0.5 ? a.cov : b.cov,
		a.path + s * (b.path - a.path)};
}

void CRecordedOdometry::clone()
{
	m_clone = m_now;
}

Matrix6d CRecordedOdometry::perMetre(double path) const
{
	const auto variance = [&](double sigma) {
		return sigma * sigma * path + m_options.sigma_floor * m_options.sigma_floor;
	};
	Matrix6d cov = Matrix6d::Zero();
	cov.diagonal().head<3>().setConstant(variance(m_options.sigma_translation));
	cov.diagonal().tail<3>().setConstant(variance(m_options.sigma_rotation));
	return cov;
}

TPoseEstimate CRecordedOdometry::sinceClone() const
{
	TPoseEstimate estimate;
	const Isometry3d T_clone_odom = m_clone.T_odom_body.inverse();
	estimate.T = T_clone_odom * m_now.T_odom_body;
	estimate.path_length = m_now.path - m_clone.path;
	if (estimate.path_length == 0 && m_now.stamp == m_clone.stamp) return estimate;	 // the very same pose
	// Absolute covariances say nothing of their correlation; as independent they bound the displacement's
	// from above when the errors are alike.
	estimate.cov =
		m_options.covariance == "per_metre"
			? perMetre(estimate.path_length)
			: composeCovariance(
				  inverseCovariance(m_clone.T_odom_body, m_clone.cov), m_now.T_odom_body, m_now.cov);
	return estimate;
}

TBodyMotion CRecordedOdometry::motion() const
{
	if (m_history.size() < 2) return {};
	const TRecord &before = *std::prev(m_history.end(), 2), &last = m_history.back();
	const Isometry3d T_before_last = before.T_odom_body.inverse() * last.T_odom_body;
	const double dt = last.stamp - before.stamp;
	return {
		last.T_odom_body.linear().transpose() *
			(last.T_odom_body.translation() - before.T_odom_body.translation()) / dt,
		logSO3(T_before_last.linear()) / dt};
}

TPoseEstimate CRecordedOdometry::now() const
{
	return {
		m_now.T_odom_body, m_options.covariance == "per_metre" ? perMetre(m_now.path) : m_now.cov,
		m_now.path};
}
}  // namespace posidonia
