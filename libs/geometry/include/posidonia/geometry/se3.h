#pragma once

#include <Eigen/Dense>

/** Poses, perturbations and covariances, said once for the whole project.
 *
 * A pose is an Eigen::Isometry3d named T_a_b: it maps coordinates of frame b to frame a.
 * A perturbation is d = (rho, phi): translation [m] first, then rotation vector [rad], both in the pose's own
 * (right-hand, "body") frame:  retract(T, d) = (t + R rho, R Exp(phi)).
 * A pose covariance is that of d, 6x6 in this order; an information matrix is its inverse.
 * To first order this is the right perturbation of SE(3), so the adjoint propagates covariances
 * (Sola, Deray, Atchuthan: A micro Lie theory for state estimation in robotics, 2018, arXiv 1812.01537). */
namespace posidonia
{
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/** Cross-product matrix: skew(a) b = a x b. */
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/** Rotation of a rotation vector [rad] (Rodrigues), exact series near zero. */
Eigen::Matrix3d expSO3(const Eigen::Vector3d& phi);

/** Rotation vector of R, |phi| <= pi; stable near 0 and near pi. */
Eigen::Vector3d logSO3(const Eigen::Matrix3d& R);

/** Right Jacobian: Exp(phi + d) ~ Exp(phi) Exp(Jr d). */
Eigen::Matrix3d rightJacobianSO3(const Eigen::Vector3d& phi);
Eigen::Matrix3d rightJacobianInverseSO3(const Eigen::Vector3d& phi);

/** T perturbed by d = (rho, phi) in its own frame. */
Eigen::Isometry3d retract(const Eigen::Isometry3d& T, const Vector6d& d);

/** d with retract(T, d) = U. */
Vector6d localCoordinates(const Eigen::Isometry3d& T, const Eigen::Isometry3d& U);

/** Adjoint in the order (rho, phi): retract(I, Ad(T) d) T = T retract(I, d) to first order. */
Matrix6d adjoint(const Eigen::Isometry3d& T);

/** Covariance of T_a_b * T_b_c from independent T_a_b and T_b_c. */
Matrix6d composeCovariance(const Matrix6d& cov_a_b, const Eigen::Isometry3d& T_b_c, const Matrix6d& cov_b_c);

/** Covariance of inverse(T) from that of T. */
Matrix6d inverseCovariance(const Eigen::Isometry3d& T, const Matrix6d& cov);

/** Covariance of X * T * Y for exact X and Y (X drops out), e.g. a camera's motion told as the body's. */
Matrix6d changeFrameCovariance(const Matrix6d& cov_T, const Eigen::Isometry3d& Y);

/** Rotation of yaw, pitch, roll [rad] (z-y-x: R = Rz(yaw) Ry(pitch) Rx(roll)). */
Eigen::Matrix3d rotationFromYawPitchRoll(double yaw, double pitch, double roll);

/** (yaw, pitch, roll) [rad] of R; pitch in [-pi/2, pi/2]. */
Eigen::Vector3d yawPitchRoll(const Eigen::Matrix3d& R);

/** The nearest rotation to a matrix that has drifted by rounding. */
Eigen::Isometry3d orthonormalized(const Eigen::Isometry3d& T);

/** Angle wrapped to (-pi, pi]. */
double wrapAngle(double radians);

/** Symmetric and positive definite (all entries finite)? */
bool isPositiveDefinite(const Matrix6d& M);
}  // namespace posidonia
