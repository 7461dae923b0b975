#include <posidonia/posegraph/edge_residual.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
/** E with its quaternion, and the predicted T_from_to that gave it. */
struct TError
{
	Matrix3d R_pred, R;	 // of the predicted edge, of E
	Vector3d t_pred, t;
	Eigen::Quaterniond q;  // of E, q.w >= 0

	TError(const TPoseEdge& edge, const Isometry3d& T_map_from, const Isometry3d& T_map_to)
	{
		const auto& M = edge.T_from_to;
		R_pred.noalias() = T_map_from.linear().transpose() * T_map_to.linear();
		t_pred.noalias() =
			T_map_from.linear().transpose() * (T_map_to.translation() - T_map_from.translation());
		R.noalias() = M.linear().transpose() * R_pred;
		t.noalias() = M.linear().transpose() * (t_pred - M.translation());
		q = R;
		if (q.w() < 0) q.coeffs() *= -1;
	}

	Vector6d residual() const { return (Vector6d() << t, 2 * q.vec()).finished(); }

	/** d(2 vec q)/d phi: q (1, phi/2) has vector part vec q + (w I + [v]x) phi / 2. */
	Matrix3d rotationJacobian() const { return q.w() * Matrix3d::Identity() + skew(q.vec()); }

	/** d_to = -Ad d_from has the same effect on E to first order, with Ad that of the predicted T_to_from. */
	Matrix6d adjointToFrom() const
	{
		Matrix6d Ad;
		const Matrix3d R_to_from = R_pred.transpose();
		const Vector3d t_to_from = -(R_to_from * t_pred);
		Ad << R_to_from, skew(t_to_from) * R_to_from, Matrix3d::Zero(), R_to_from;
		return Ad;
	}
};
}  // namespace

Vector6d edgeResidual(const TPoseEdge& edge, const Isometry3d& T_map_from, const Isometry3d& T_map_to)
{
	return TError(edge, T_map_from, T_map_to).residual();
}

double edgeMahalanobis2(const TPoseEdge& edge, const Isometry3d& T_map_from, const Isometry3d& T_map_to)
{
	const Vector6d e = edgeResidual(edge, T_map_from, T_map_to);
	return e.dot(edge.information * e);
}

TEdgeJacobians edgeJacobians(const TPoseEdge& edge, const Isometry3d& T_map_from, const Isometry3d& T_map_to)
{
	const TError error(edge, T_map_from, T_map_to);
	TEdgeJacobians out;
	out.e = error.residual();
	out.J_to.setZero();
	out.J_to.topLeftCorner<3, 3>() = error.R;
	out.J_to.bottomRightCorner<3, 3>() = error.rotationJacobian();
	out.J_from = -out.J_to * error.adjointToFrom();
	return out;
}

TEdgeNormal edgeNormal(const TPoseEdge& edge, const Isometry3d& T_map_from, const Isometry3d& T_map_to)
{
	const TError error(edge, T_map_from, T_map_to);
	const Vector6d e = error.residual();
	const Vector6d Omega_e = edge.information * e;
	const Matrix3d B = error.rotationJacobian();

	// J_to = diag(R, B).
	Matrix6d Omega_J;
	Omega_J.leftCols<3>().noalias() = edge.information.leftCols<3>() * error.R;
	Omega_J.rightCols<3>().noalias() = edge.information.rightCols<3>() * B;

	TEdgeNormal out;
	out.s = e.dot(Omega_e);
	out.H_to_to.topRows<3>().noalias() = error.R.transpose() * Omega_J.topRows<3>();
	out.H_to_to.bottomRows<3>().noalias() = B.transpose() * Omega_J.bottomRows<3>();
	out.g_to.head<3>().noalias() = error.R.transpose() * Omega_e.head<3>();
	out.g_to.tail<3>().noalias() = B.transpose() * Omega_e.tail<3>();

	const Matrix6d Ad = error.adjointToFrom();
	out.H_from_to.noalias() = -Ad.transpose() * out.H_to_to;
	out.H_from_from.noalias() = -out.H_from_to * Ad;
	out.g_from.noalias() = -Ad.transpose() * out.g_to;
	return out;
}
}  // namespace posidonia
