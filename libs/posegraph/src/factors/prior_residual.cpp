#include <posidonia/posegraph/prior_residual.h>

#include <algorithm>
#include <cmath>

#include "factors/pose_error.h"

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
/** Residual of a turn Q = R R_measured^T and its derivative A for Q moved to Exp(omega) Q, omega in map axes.
 * Unused rows are zero. */
struct TTurn
{
	Vector3d e{Vector3d::Zero()};
	Matrix3d A{Matrix3d::Zero()};
};

Eigen::Quaterniond quaternionOf(const Matrix3d& Q)
{
	Eigen::Quaterniond q(Q);
	if (q.w() < 0) q.coeffs() *= -1;
	return q;
}

/** (1, omega/2) q has vector part v + (w I - [v]x) omega / 2. */
TTurn wholeTurn(const Matrix3d& Q)
{
	const auto q = quaternionOf(Q);
	return {2 * q.vec(), q.w() * Matrix3d::Identity() - skew(q.vec())};
}

/** Twist about down, psi = 2 atan2(q.z, q.w): e = 2 sin(psi/2). */
TTurn turnAboutDown(const Matrix3d& Q)
{
	const auto q = quaternionOf(Q);
	const Vector3d v = q.vec();
	const double n = std::max(std::hypot(q.w(), v.z()), 1e-9);	// 0 for a tilt by pi alone
	TTurn turn;
	turn.e[0] = 2 * v.z() / n;
	const Vector3d dz(v.y(), -v.x(), q.w());  // d v.z = dz omega / 2, d q.w = -v omega / 2
	turn.A.row(0) = q.w() / (n * n * n) * (q.w() * dz + v.z() * v).transpose();
	return turn;
}

/** The measured down, u = Q (0,0,1) in map axes by the present attitude, is turned against down by an angle
 * about a horizontal axis: e = 2 sin(angle/2) axis. */
TTurn turnAboutHorizontal(const Matrix3d& Q)
{
	const Vector3d u = Q.col(2);
	const double up = std::max(1 + u.z(), 1e-9);  // 0 for upside down
	const double k = std::sqrt(2 / up);
	const Matrix3d du = -skew(u);  // by omega
	TTurn turn;
	turn.e << -k * u.y(), k * u.x(), 0;
	turn.A.row(0) = -k * du.row(1);
	turn.A.row(1) = k * du.row(0);
	turn.A.topRows<2>() -= turn.e.head<2>() / (2 * up) * du.row(2);
	return turn;
}

TTurn turnOf(EPriorKind kind, const Matrix3d& Q)
{
	if (kind == EPriorKind::RollPitch) return turnAboutHorizontal(Q);
	return kind == EPriorKind::Heading ? turnAboutDown(Q) : wholeTurn(Q);
}

/** The rotation vector in map axes of a turn's first entries. */
Eigen::Matrix<double, 3, 6> axesOf(EPriorKind kind)
{
	Eigen::Matrix<double, 3, 6> axes = Eigen::Matrix<double, 3, 6>::Zero();
	if (kind == EPriorKind::Heading)
		axes(2, 0) = 1;
	else
		axes.leftCols<3>().setIdentity();
	return axes;  // RollPitch: the third entry is zero in every sensitivity
}

bool isTurn(EPriorKind kind)
{
	return kind == EPriorKind::RollPitch || kind == EPriorKind::Heading || kind == EPriorKind::Attitude;
}

/** u = sensitivity c, zero without an error variable. */
Vector6d correctionOf(const TPosePrior& prior, const TNodeStates& states)
{
	if (prior.error_variable < 0) return Vector6d::Zero();
	return prior.sensitivity * states.values[prior.error_variable];
}

TPriorJacobians turnJacobians(const TPosePrior& prior, const Eigen::Isometry3d& T, const Vector6d& u)
{
	const auto axes = axesOf(prior.kind);
	const Vector3d w = axes * u;
	const Matrix3d Q = T.linear() * (expSO3(w) * prior.T_map_node.linear()).transpose();
	const TTurn turn = turnOf(prior.kind, Q);
	TPriorJacobians out{Vector6d::Zero(), Matrix6d::Zero(), Matrix6d::Zero()};
	out.e.head<3>() = turn.e;
	out.J_node.topRightCorner<3, 3>() = turn.A * T.linear();
	// Exp(w + dw) = Exp(Jl dw) Exp(w), Jl(w) = Jr(-w): Q becomes Q Exp(-Jl dw).
	out.J_error.topRows<3>() = -turn.A * Q * rightJacobianSO3(-w) * axes * prior.sensitivity;
	return out;
}

/** First row of the position that the kind compares, and how many. */
std::pair<int, int> positionRows(EPriorKind kind)
{
	return {kind == EPriorKind::Depth ? 2 : 0, priorDimension(kind)};
}

TPriorJacobians positionJacobians(const TPosePrior& prior, const Eigen::Isometry3d& T, const Vector6d& u)
{
	const auto [first, rows] = positionRows(prior.kind);
	TPriorJacobians out{Vector6d::Zero(), Matrix6d::Zero(), -prior.sensitivity};
	out.e.head(rows) = (T.translation() - prior.T_map_node.translation()).segment(first, rows) - u.head(rows);
	out.J_node.topLeftCorner(rows, 3) = T.linear().middleRows(first, rows);
	return out;
}

TPriorJacobians fullPoseJacobians(const TPosePrior& prior, const Eigen::Isometry3d& T, const Vector6d& u)
{
	const TPoseError error(retract(prior.T_map_node, u), T.linear(), T.translation());
	return {error.residual(), error.predictedJacobian(), error.measuredJacobian(u) * prior.sensitivity};
}
}  // namespace

TPriorJacobians priorJacobians(const TPosePrior& prior, const TNodeStates& states)
{
	if (prior.kind == EPriorKind::ErrorVariable)
		return {states.values[prior.node] - prior.value, Matrix6d::Identity(), Matrix6d::Zero()};
	const Vector6d u = correctionOf(prior, states);
	const Eigen::Isometry3d& T = states.poses[prior.node];
	if (isTurn(prior.kind)) return turnJacobians(prior, T, u);
	return prior.kind == EPriorKind::FullPose ? fullPoseJacobians(prior, T, u)
											  : positionJacobians(prior, T, u);
}

Vector6d priorResidual(const TPosePrior& prior, const TNodeStates& states)
{
	return priorJacobians(prior, states).e;
}

double priorMahalanobis2(const TPosePrior& prior, const TNodeStates& states)
{
	const Vector6d e = priorResidual(prior, states);
	return e.dot(prior.information * e);
}

TFactorNormal linearizePrior(const TPosePrior& prior, const TNodeStates& states)
{
	const TPriorJacobians J = priorJacobians(prior, states);
	const Vector6d Omega_e = prior.information * J.e;
	const Matrix6d Jt_Omega = J.J_node.transpose() * prior.information;
	TFactorNormal out;
	out.s = J.e.dot(Omega_e);
	out.count = prior.error_variable < 0 ? 1 : 2;
	out.node[0] = prior.node;
	out.node[1] = prior.error_variable;
	out.node[2] = -1;
	out.g[0].noalias() = J.J_node.transpose() * Omega_e;
	out.H[0].noalias() = Jt_Omega * J.J_node;
	if (out.count == 1) return out;
	out.g[1].noalias() = J.J_error.transpose() * Omega_e;
	out.H[1].noalias() = J.J_error.transpose() * (prior.information * J.J_node).eval();
	out.H[2].noalias() = J.J_error.transpose() * (prior.information * J.J_error).eval();
	return out;
}
}  // namespace posidonia
