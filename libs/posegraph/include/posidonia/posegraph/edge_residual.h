#pragma once

#include <posidonia/posegraph/pose_graph.h>

/** The residual of a relative-pose edge and its derivatives (README, "Residual").
 *
 *   E = inverse(T_from_to) inverse(T_map_from) T_map_to,   e = (t(E), 2 vec q(E)),  q.w >= 0.
 *
 * The derivatives are with respect to retract(T_map_from, d_from) and retract(T_map_to, d_to). */
namespace posidonia
{
struct TEdgeJacobians
{
	Vector6d e;
	Matrix6d J_from, J_to;
};

/** An edge's share of the normal equations: Gauss-Newton Hessian blocks J^T Omega J and J^T Omega e. */
struct TEdgeNormal
{
	double s;  ///< e^T Omega e
	Matrix6d H_from_from, H_from_to, H_to_to;
	Vector6d g_from, g_to;
};

/** e = (translation [m], 2 x vector part of the quaternion [~rad]). */
Vector6d edgeResidual(
	const TPoseEdge& edge, const Eigen::Isometry3d& T_map_from, const Eigen::Isometry3d& T_map_to);

/** Squared Mahalanobis distance e^T Omega e. */
double edgeMahalanobis2(
	const TPoseEdge& edge, const Eigen::Isometry3d& T_map_from, const Eigen::Isometry3d& T_map_to);

TEdgeJacobians edgeJacobians(
	const TPoseEdge& edge, const Eigen::Isometry3d& T_map_from, const Eigen::Isometry3d& T_map_to);

/** The same derivatives squared, without forming J_from: half the work of three 6x6 triple products. */
TEdgeNormal edgeNormal(
	const TPoseEdge& edge, const Eigen::Isometry3d& T_map_from, const Eigen::Isometry3d& T_map_to);
}  // namespace posidonia
