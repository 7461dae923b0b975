#include <posidonia/nav/rts_smoother.h>

#include <algorithm>

namespace posidonia
{
CRtsSmoother::CRtsSmoother(std::shared_ptr<const TNavigatorSetup> setup)
	: m_setup(std::move(setup)), m_navigator(m_setup)
{
	m_navigator.withoutEdges();
}

std::vector<CRtsSmoother::TSegment> CRtsSmoother::filterForward(const std::vector<TSensorReading>& readings)
{
	constexpr double kLength = 10;	// [s]
	std::vector<TSegment> segments;
	for (size_t i = 0; i < readings.size(); i++) {
		const bool due = segments.empty() || readings[i].stamp - segments.back().from.stamp() >= kLength;
		if (m_navigator.ready() && due) segments.push_back({m_navigator.snapshot(), i});
		m_navigator.apply(readings[i]);
	}
	return segments;
}

void CRtsSmoother::replay(const TSegment& segment, const std::vector<TSensorReading>& readings, size_t end)
{
	m_steps.clear();
	m_navigator.restore(segment.from);
	for (size_t i = segment.begin; i < end; i++)
		m_navigator.apply(readings[i]);
}

void CRtsSmoother::predicted(
	const TNavigationState& x, const MatrixMoving& P, const MatrixMoving& F,
	const TNavigationState& x_predicted, const MatrixMoving& P_predicted)
{
	m_steps.push_back({x, x_predicted, P, F, P_predicted, m_navigator.stamp()});
}

void CRtsSmoother::stepBack(const TStep& step)
{
	// G = P F^T P_predicted^-1; states that are exact (zero rows) drop out of the LDL^T.
	const MatrixMoving G = step.P_predicted.ldlt().solve(step.F * step.P).transpose();
	VectorNav correction = VectorNav::Zero();
	correction.head<kMovingSize>() = G * localCoordinates(step.x_predicted, m_x).head<kMovingSize>();
	m_x = retract(step.x, correction);
	const MatrixMoving P = step.P + G * (m_P - step.P_predicted) * G.transpose();
	m_P = 0.5 * (P + P.transpose());
}

TStampedEstimate CRtsSmoother::estimate(double stamp) const
{
	TStampedEstimate e{stamp, {}};
	const Eigen::Isometry3d T_nav_body = m_setup->T_nav_body();
	Matrix6d J = Matrix6d::Identity();	// odom axes to the pose's own
	J.topLeftCorner<3, 3>() = m_x.R_odom_body.transpose();
	e.pose.T = m_x.T_odom_nav() * T_nav_body;
	e.pose.cov = changeFrameCovariance(J * m_P.topLeftCorner<6, 6>() * J.transpose(), T_nav_body);
	return e;
}

std::vector<TStampedEstimate> CRtsSmoother::smooth(std::vector<TSensorReading> readings, double period)
{
	std::stable_sort(
		readings.begin(), readings.end(), [](const auto& a, const auto& b) { return a.isBefore(b); });
	const std::vector<TSegment> segments = filterForward(readings);
	std::vector<TStampedEstimate> poses;
	if (segments.empty()) return poses;
	m_x = m_navigator.navigationFilter().state();
	m_P = m_navigator.navigationFilter().covariance().topLeftCorner<kMovingSize, kMovingSize>();
	m_navigator.navigationFilter().observe(this);
	size_t end = readings.size();
	for (auto segment = segments.rbegin(); segment != segments.rend(); ++segment) {
		replay(*segment, readings, end);
		end = segment->begin;
		for (auto step = m_steps.rbegin(); step != m_steps.rend(); ++step) {
			constexpr double kSlack = 0.999;  // stamps are not exact multiples of the period
			if (poses.empty() || step->end <= poses.back().stamp - kSlack * period)
				poses.push_back(estimate(step->end));
			stepBack(*step);
		}
	}
	m_navigator.navigationFilter().observe(nullptr);
	std::reverse(poses.begin(), poses.end());
	return poses;
}
}  // namespace posidonia
