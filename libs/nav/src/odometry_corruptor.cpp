#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/nav/odometry_corruptor.h>

namespace posidonia
{
using Eigen::Vector3d;

COdometryCorruptor::COdometryCorruptor(
	std::unique_ptr<COdometrySource> source, const TOdometryCorruptionOptions& options)
	: m_source(std::move(source)), m_options(options), m_rng(options.seed)
{
}

void COdometryCorruptor::add(const mrpt::obs::CObservation& observation)
{
	m_source->add(observation);
	if (!m_source->ready()) return;
	if (!m_started) start();
	if (!isActive() || !dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation)) return;
	const Vector3d position = m_source->now().T.translation();
	const double way = (position - m_last_position).norm();
	m_offset += driftPerMetre() * way + randomStep(way);
	m_last_position = position;
}

/** The way counts from the pose at which the source became ready. */
void COdometryCorruptor::start()
{
	const TPoseEstimate first = m_source->now();
	m_last_position = first.T.translation();
	m_R_map_clone = first.T.linear();
	m_started = true;
}

Vector3d COdometryCorruptor::randomStep(double way)
{
	std::normal_distribution<double> normal;
	const double north = normal(m_rng), east = normal(m_rng), down = normal(m_rng);
	return m_options.random_share * std::sqrt(way) *
		   driftPerMetre().cwiseProduct(Vector3d(north, east, down));
}

Vector3d COdometryCorruptor::offset() const
{
	if (!isActive()) return Vector3d::Zero();
	return m_offset + driftPerMetre() * (m_source->now().T.translation() - m_last_position).norm();
}

void COdometryCorruptor::clone()
{
	constexpr size_t kRemembered = 64;	// far more edges than end within the filter's hold
	m_drifts.push_back({m_clones++, m_R_map_clone, offset() - m_offset_at_clone, offset()});
	if (m_drifts.size() > kRemembered) m_drifts.pop_front();
	m_source->clone();
	m_offset_at_clone = offset();
	m_R_map_clone = m_source->now().T.linear();
}

Matrix6d COdometryCorruptor::declaredCovariance(double way, const Eigen::Matrix3d& R_map_body) const
{
	const Vector3d sigma =
		way * Vector3d(m_options.declaredXY(), m_options.declaredXY(), m_options.declaredZ());
	Matrix6d cov = Matrix6d::Zero();
	cov.topLeftCorner<3, 3>() = R_map_body.transpose() * sigma.cwiseAbs2().asDiagonal() * R_map_body;
	return cov;
}

TPoseEstimate COdometryCorruptor::sinceClone() const
{
	return corrupted(m_source->sinceClone(), m_R_map_clone, offset() - m_offset_at_clone);
}

TPoseEstimate COdometryCorruptor::corrupted(
	TPoseEstimate edge, const Eigen::Matrix3d& R_map_from, const Vector3d& drift) const
{
	edge.T.translation() += R_map_from.transpose() * drift;
	edge.cov += declaredCovariance(edge.path_length, R_map_from * edge.T.linear());
	return edge;
}

std::vector<TRevisedEdge> COdometryCorruptor::takeRevisedEdges()
{
	std::vector<TRevisedEdge> revised;
	for (TRevisedEdge& r : m_source->takeRevisedEdges())
		for (const TEdgeDrift& d : m_drifts)
			if (d.clone == r.clone) {
				r.edge = corrupted(r.edge, d.R_map_from, d.drift);
				r.T_odom_body.translation() += d.offset;
				revised.push_back(r);
			}
	return revised;
}

TPoseEstimate COdometryCorruptor::now() const
{
	TPoseEstimate pose = m_source->now();
	pose.T.translation() += offset();
	pose.cov += declaredCovariance(pose.path_length, pose.T.linear());
	return pose;
}

TDeclaredDrift COdometryCorruptor::declaredDrift() const
{
	const TDeclaredDrift own = m_source->declaredDrift();
	return {std::hypot(own.sigma_xy, m_options.declaredXY()), std::hypot(own.sigma_z, m_options.declaredZ())};
}
}  // namespace posidonia
