#include <posidonia/nav/measurements.h>

namespace posidonia
{
using Eigen::Vector3d;

namespace
{
/** Variance of the first rows, 1 for the padding. */
CMeasurement::Noise padded(double variance, int rows)
{
	CMeasurement::Noise R = CMeasurement::Noise::Identity();
	R.diagonal().head(rows).setConstant(variance);
	return R;
}
}  // namespace

CDepthMeasurement::CDepthMeasurement(double depth, double sigma, const Vector3d& lever)
	: CMeasurement(Value(depth, 0, 0, 0), padded(sigma * sigma, 1)), m_lever(lever)
{
}

CMeasurement::Value CDepthMeasurement::predicted(const TNavigationState& x) const
{
	return {x.position.z() + x.R_odom_body.row(2).dot(m_lever) + x.pressure_offset, 0, 0, 0};
}

CMeasurement::Jacobian CDepthMeasurement::jacobian(const TNavigationState& x) const
{
	Jacobian H = Jacobian::Zero();
	H(0, kPosition + 2) = 1;
	H.block<1, 3>(0, kAttitude) = -x.R_odom_body.row(2) * skew(m_lever);
	H(0, kPressureOffset) = 1;
	return H;
}

CHorizontalMeasurement::CHorizontalMeasurement(
	const Eigen::Vector2d& north_east, double sigma, const Vector3d& lever)
	: CMeasurement(Value(north_east.x(), north_east.y(), 0, 0), padded(sigma * sigma, 2)), m_lever(lever)
{
}

CMeasurement::Value CHorizontalMeasurement::predicted(const TNavigationState& x) const
{
	const Vector3d antenna = x.position + x.R_odom_body * m_lever;
	return {antenna.x() + x.gps_bias.x(), antenna.y() + x.gps_bias.y(), 0, 0};
}

CMeasurement::Jacobian CHorizontalMeasurement::jacobian(const TNavigationState& x) const
{
	Jacobian H = Jacobian::Zero();
	H.block<2, 2>(0, kPosition).setIdentity();
	H.block<2, 3>(0, kAttitude) = -x.R_odom_body.topRows<2>() * skew(m_lever);
	H.block<2, 2>(0, kGpsBias).setIdentity();
	return H;
}
}  // namespace posidonia
