#pragma once

#include <posidonia/geometry/se3.h>

namespace posidonia
{
/** E = inverse(measured) predicted, with its residual and derivatives (README, "Residual"): shared by edges
 * and full-pose priors. */
struct TPoseError
{
	Eigen::Matrix3d R;	   ///< of E
	Eigen::Vector3d t;	   ///< of E
	Eigen::Quaterniond q;  ///< of E, q.w >= 0

	TPoseError(
		const Eigen::Isometry3d& measured, const Eigen::Matrix3d& R_predicted,
		const Eigen::Vector3d& t_predicted)
	{
		R.noalias() = measured.linear().transpose() * R_predicted;
		t.noalias() = measured.linear().transpose() * (t_predicted - measured.translation());
		q = R;
		if (q.w() < 0) q.coeffs() *= -1;
	}

	Vector6d residual() const { return (Vector6d() << t, 2 * q.vec()).finished(); }

	/** d(2 vec q)/d phi: q (1, phi/2) has vector part vec q + (w I + [v]x) phi / 2. */
	Eigen::Matrix3d rotationJacobian() const { return q.w() * Eigen::Matrix3d::Identity() + skew(q.vec()); }

	/** de/dd for the predicted pose moved to retract(predicted, d). */
	Matrix6d predictedJacobian() const
	{
		Matrix6d J = Matrix6d::Zero();
		J.topLeftCorner<3, 3>() = R;
		J.bottomRightCorner<3, 3>() = rotationJacobian();
		return J;
	}

	/** de/du for measured = retract(M, u). Adding (drho, dphi) to u moves `measured` to
	 * retract(measured, (Exp(-phi) drho, Jr(phi) dphi)), and retract(measured, d) changes E to
	 * inverse(retract(I, d)) E. */
	Matrix6d measuredJacobian(const Vector6d& u) const
	{
		const Eigen::Vector3d phi = u.tail<3>();
		const Eigen::Matrix3d Jr = rightJacobianSO3(phi);
		Matrix6d J = Matrix6d::Zero();
		J.topLeftCorner<3, 3>() = -expSO3(-phi);
		J.topRightCorner<3, 3>() = skew(t) * Jr;
		J.bottomRightCorner<3, 3>() = (skew(q.vec()) - q.w() * Eigen::Matrix3d::Identity()) * Jr;
		return J;
	}
};
}  // namespace posidonia
