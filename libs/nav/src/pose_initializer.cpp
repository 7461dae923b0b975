#include <posidonia/nav/measurements.h>
#include <posidonia/nav/pose_initializer.h>

namespace posidonia
{
using Eigen::Vector2d;
using Eigen::Vector3d;

CPoseInitializer::CPoseInitializer(const TInitialPoseOptions& options, const Vector3d& origin)
	: m_options(options), m_origin(origin)
{
}

void CPoseInitializer::addAttitude(const TAttitudeMeasurement& attitude)
{
	m_attitude = attitude;
}

void CPoseInitializer::addDepth(double depth, double sigma, const Vector3d& lever)
{
	m_depth = TScalarMeasurement{depth, sigma};
	m_depth_lever = lever - m_origin;
}

void CPoseInitializer::addFix(double stamp, const Vector2d& north_east, double sigma, const Vector3d& lever)
{
	if (!m_attitude) return;
	if (m_fixes > 0 && stamp - m_last_fix > m_options.gps_max_gap) {
		m_fixes = 0;
		m_sum = m_sum_squares = Vector2d::Zero();
	}
	const Vector2d body = north_east - (m_attitude->R_map_body * (lever - m_origin)).head<2>();
	m_fixes++;
	m_last_fix = stamp;
	m_fix_sigma = sigma;
	m_sum += body;
	m_sum_squares += body.cwiseAbs2();
}

bool CPoseInitializer::complete() const
{
	return m_options.known || (m_attitude && m_depth && m_fixes >= m_options.gps_fixes);
}

TPoseEstimate CPoseInitializer::pose() const
{
	return m_options.known ? knownPose() : measuredPose();
}

namespace
{
/** Covariance over (rho, phi) of a pose whose errors are given along and about map axes. */
Matrix6d ownFrameCovariance(
	const Eigen::Matrix3d& R, const Vector3d& position_variance, double sigma_roll_pitch,
	double sigma_heading)
{
	Matrix6d cov = Matrix6d::Zero();
	cov.topLeftCorner<3, 3>() = R.transpose() * position_variance.asDiagonal() * R;
	cov.bottomRightCorner<3, 3>() = attitudeNoise(R, sigma_roll_pitch, sigma_heading);
	return cov;
}
}  // namespace

TPoseEstimate CPoseInitializer::knownPose() const
{
	const auto& o = m_options;
	TPoseEstimate start;
	start.T.linear() = rotationFromYawPitchRoll(o.yaw, o.pitch, o.roll);
	start.T.translation() << o.position[0], o.position[1], o.position[2];
	start.cov = ownFrameCovariance(
		start.T.linear(), Vector3d(o.sigma_xy, o.sigma_xy, o.sigma_z).cwiseAbs2(), o.sigma_roll_pitch,
		o.sigma_heading);
	return start;
}

TPoseEstimate CPoseInitializer::measuredPose() const
{
	const Vector2d mean = m_sum / m_fixes;
	// A way L covered while averaging spreads the fixes by L^2/12 and puts the mean L/2 behind: 3 x the
	// spread.
	const double white = m_fix_sigma * m_fix_sigma;
	const Vector2d spread = (m_sum_squares / m_fixes - mean.cwiseAbs2()).array() - white;
	const Vector2d variance = Vector2d::Constant(white / m_fixes) + 3 * spread.cwiseMax(0);
	const Eigen::Matrix3d& R = m_attitude->R_map_body;
	TPoseEstimate start;
	start.T.linear() = R;
	start.T.translation() << mean, m_depth->value - R.row(2).dot(m_depth_lever);
	start.cov = ownFrameCovariance(
		R, Vector3d(variance.x(), variance.y(), m_depth->sigma * m_depth->sigma),
		m_attitude->sigma_roll_pitch, m_attitude->sigma_heading);
	return start;
}
}  // namespace posidonia
