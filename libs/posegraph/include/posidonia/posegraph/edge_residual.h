#pragma once

#include <posidonia/posegraph/factor_normal.h>

/** The residual of a relative-pose edge and its derivatives (README, "Residual").
 *
 *   E = inverse(T) inverse(T_map_from) T_map_to,   e = (t(E), 2 vec q(E)),  q.w >= 0,
 *   T = retract(T_from_to, sensitivity c), or T_from_to without an error variable.
 *
 * The derivatives are with respect to retract(T_map_from, d_from), retract(T_map_to, d_to) and c + d_c. */
namespace posidonia
{
struct TEdgeJacobians
{
	Vector6d e;
	Matrix6d J_from, J_to, J_error;
};

/** e = (translation [m], 2 x vector part of the quaternion [~rad]). @param c value of the error variable */
Vector6d edgeResidual(
	const TPoseEdge& edge, const Eigen::Isometry3d& T_map_from, const Eigen::Isometry3d& T_map_to,
	const Vector6d& c = Vector6d::Zero());

TEdgeJacobians edgeJacobians(
	const TPoseEdge& edge, const Eigen::Isometry3d& T_map_from, const Eigen::Isometry3d& T_map_to,
	const Vector6d& c = Vector6d::Zero());
}  // namespace posidonia
