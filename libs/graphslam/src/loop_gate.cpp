#include <posidonia/base/chi_square.h>
#include <posidonia/graphslam/loop_gate.h>

#include <cmath>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;

Matrix6d largerOfGraphAndDrift(
	const Matrix6d& covariance, const Matrix3d& R_map_j, const Eigen::Vector3d& drift_variance)
{
	// To map axes, where the drift is told; then back.
	Matrix6d to_map = Matrix6d::Identity();
	to_map.topLeftCorner<3, 3>() = R_map_j;
	Matrix6d C = to_map * covariance * to_map.transpose();
	for (int axis = 0; axis < 3; axis++) {
		if (drift_variance[axis] <= C(axis, axis)) continue;
		C.row(axis).setZero();
		C.col(axis).setZero();
		C(axis, axis) = drift_variance[axis];
	}
	return to_map.transpose() * C * to_map;
}

CLoopGate::CLoopGate(const TGateOptions& options)
	: m_options(options), m_threshold(chiSquareQuantile(options.confidence, 6))
{
}

double CLoopGate::mahalanobis2(
	const TRelativePrediction& prediction, const Isometry3d& T_i_j, const Matrix6d& information) const
{
	Matrix6d S = prediction.covariance + Matrix6d(information.inverse());
	for (int k = 0; k < 6; k++) {
		const double floor = k < 3 ? m_options.sigma_floor_xyz : m_options.sigma_floor_angle;
		S(k, k) += floor * floor;
	}
	const Vector6d d = localCoordinates(prediction.T_i_j, T_i_j);
	return d.dot(S.ldlt().solve(d));
}

std::optional<std::string> CLoopGate::refuse(
	const TRelativePrediction& prediction, const Isometry3d& T_i_j, const Matrix6d& information) const
{
	if (m_options.kind == "jump") {
		const double jump = (T_i_j.translation() - prediction.T_i_j.translation()).norm();
		if (jump > m_options.max_jump) return "refused by the jump gate";
		return {};
	}
	if (mahalanobis2(prediction, T_i_j, information) > m_threshold) return "refused by the chi-square gate";
	return {};
}
}  // namespace posidonia
