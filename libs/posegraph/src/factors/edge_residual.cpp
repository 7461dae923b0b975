#include <posidonia/posegraph/edge_residual.h>

#include "factors/pose_error.h"

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
/** inverse(T_map_from) T_map_to */
struct TPredicted
{
	Matrix3d R;
	Vector3d t;

	TPredicted(const Isometry3d& T_map_from, const Isometry3d& T_map_to)
	{
		R.noalias() = T_map_from.linear().transpose() * T_map_to.linear();
		t.noalias() = T_map_from.linear().transpose() * (T_map_to.translation() - T_map_from.translation());
	}

	/** d_to = -Ad d_from has the same effect on E to first order, with Ad that of the predicted T_to_from. */
	Matrix6d adjointToFrom() const
	{
		Matrix6d Ad;
		const Matrix3d R_to_from = R.transpose();
		const Vector3d t_to_from = -(R_to_from * t);
		Ad << R_to_from, skew(t_to_from) * R_to_from, Matrix3d::Zero(), R_to_from;
		return Ad;
	}
};

/** Measurement and prediction of an edge between two poses. */
struct TEdgeError
{
	TPredicted predicted;
	TPoseError error;

	TEdgeError(const TPoseEdge& edge, const TNodeStates& states)
		: predicted(states.poses[edge.from], states.poses[edge.to]),
		  error(
			  edge.error_variable < 0 ? edge.T_from_to
									  : correctedMeasurement(edge, states.values[edge.error_variable]),
			  predicted.R, predicted.t)
	{
	}
};

/** The blocks of both poses. With J_to = diag(R, B) let J_to^T Omega J_to = [P Q; Q^T S]; J_from = -J_to Ad,
 * Ad = [A [t]x A; 0 A] with A, t of the predicted T_to_from. So, with X = P [t]x + Q and Y = Q^T [t]x + S,
 * H_to_from = -[P A, X A; Q^T A, Y A] and H_from_from = [A^T P A, A^T X A; ., A^T (Y - [t]x X) A]. */
void setPoseBlocks(
	const Matrix6d& Omega, const Vector6d& Omega_e, const TPredicted& predicted, const TPoseError& error,
	TFactorNormal& out)
{
	const Matrix3d &R = error.R, B = error.rotationJacobian();
	const Matrix3d& A_t = predicted.R;	// A transposed
	const Matrix3d A = A_t.transpose();
	const Vector3d t = -(A * predicted.t);
	const Matrix3d t_x = skew(t);

	const Matrix3d P = R.transpose() * (Omega.topLeftCorner<3, 3>() * R).eval();
	const Matrix3d Q = R.transpose() * (Omega.topRightCorner<3, 3>() * B).eval();
	const Matrix3d S = B.transpose() * (Omega.bottomRightCorner<3, 3>() * B).eval();
	const Matrix3d Q_t = Q.transpose();
	const Matrix3d X = P * t_x + Q;
	const Matrix3d Y = Q_t * t_x + S;
	const Matrix3d PA = P * A, XA = X * A, QA = Q_t * A, YA = Y * A;
	const Matrix3d Z = YA - t_x * XA;

	Matrix6d& H_from = out.H[0];
	H_from.topLeftCorner<3, 3>().noalias() = A_t * PA;
	H_from.topRightCorner<3, 3>().noalias() = A_t * XA;
	H_from.bottomRightCorner<3, 3>().noalias() = A_t * Z;
	H_from.bottomLeftCorner<3, 3>() = H_from.topRightCorner<3, 3>().transpose();
	out.H[1] << -PA, -XA, -QA, -YA;
	out.H[2] << P, Q, Q_t, S;

	const Vector3d g_rho = R.transpose() * Omega_e.head<3>(), g_phi = B.transpose() * Omega_e.tail<3>();
	out.g[0] << -(A_t * g_rho), A_t * (t.cross(g_rho) - g_phi);
	out.g[1] << g_rho, g_phi;
}

/** The third row of blocks, of the error variable. */
void setErrorBlocks(
	const TPoseEdge& edge, const Vector6d& c, const Vector6d& Omega_e, const TEdgeError& e,
	TFactorNormal& out)
{
	const Matrix6d sensitivity = edge.sensitivity,
				   J = e.error.measuredJacobian(sensitivity * c) * sensitivity;
	const Matrix6d Jt_Omega = J.transpose() * edge.information;
	out.g[2].noalias() = J.transpose() * Omega_e;
	out.H[4].noalias() = Jt_Omega * e.error.predictedJacobian();
	out.H[3].noalias() = -out.H[4] * e.predicted.adjointToFrom();
	out.H[5].noalias() = Jt_Omega * J;
}

/** States of an edge's own nodes alone. */
TNodeStates statesOf(
	TPoseEdge& edge, const Isometry3d& T_map_from, const Isometry3d& T_map_to, const Vector6d& c)
{
	edge.from = 0;
	edge.to = 1;
	if (edge.error_variable >= 0) edge.error_variable = 2;
	return {{T_map_from, T_map_to, Isometry3d::Identity()}, {Vector6d::Zero(), Vector6d::Zero(), c}};
}
}  // namespace

Vector6d edgeResidual(
	const TPoseEdge& edge, const Isometry3d& T_map_from, const Isometry3d& T_map_to, const Vector6d& c)
{
	TPoseEdge alone = edge;
	const TNodeStates states = statesOf(alone, T_map_from, T_map_to, c);
	return TEdgeError(alone, states).error.residual();
}

TEdgeJacobians edgeJacobians(
	const TPoseEdge& edge, const Isometry3d& T_map_from, const Isometry3d& T_map_to, const Vector6d& c)
{
	TPoseEdge alone = edge;
	const TNodeStates states = statesOf(alone, T_map_from, T_map_to, c);
	const TEdgeError e(alone, states);
	TEdgeJacobians out;
	out.e = e.error.residual();
	out.J_to = e.error.predictedJacobian();
	out.J_from = -out.J_to * e.predicted.adjointToFrom();
	out.J_error.setZero();
	if (edge.error_variable < 0) return out;
	const Matrix6d sensitivity = edge.sensitivity;
	out.J_error = e.error.measuredJacobian(sensitivity * c) * sensitivity;
	return out;
}

double edgeMahalanobis2(const TPoseEdge& edge, const TNodeStates& states)
{
	const Vector6d e = TEdgeError(edge, states).error.residual();
	return e.dot(edge.information * e);
}

TFactorNormal linearizeEdge(const TPoseEdge& edge, const TNodeStates& states)
{
	const TEdgeError e(edge, states);
	const Vector6d residual = e.error.residual();
	const Vector6d Omega_e = edge.information * residual;
	TFactorNormal out;
	out.s = residual.dot(Omega_e);
	out.count = edge.error_variable < 0 ? 2 : 3;
	out.node[0] = edge.from;
	out.node[1] = edge.to;
	out.node[2] = edge.error_variable;
	setPoseBlocks(edge.information, Omega_e, e.predicted, e.error, out);
	if (edge.error_variable >= 0) setErrorBlocks(edge, states.values[edge.error_variable], Omega_e, e, out);
	return out;
}
}  // namespace posidonia
