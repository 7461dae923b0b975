#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPose3DPDFGaussianInf.h>
#include <posidonia/geometry/se3.h>

/** Between our poses and MRPT's. MRPT's pose covariances are over (x, y, z, yaw, pitch, roll), the
 * translation in the outer frame; ours over (rho, phi) in the pose's own frame. Singular at +-90 deg of pitch
 * (MRPT's choice). */
namespace posidonia
{
mrpt::poses::CPose3D toMrpt(const Eigen::Isometry3d& T);
Eigen::Isometry3d fromMrpt(const mrpt::poses::CPose3D& T);

/** d(x, y, z, yaw, pitch, roll) / d(rho, phi) at T, 6x6. */
Matrix6d mrptFromLocalJacobian(const Eigen::Isometry3d& T);

mrpt::poses::CPose3DPDFGaussian toMrptGaussian(const Eigen::Isometry3d& T, const Matrix6d& cov);
mrpt::poses::CPose3DPDFGaussianInf toMrptGaussianInf(const Eigen::Isometry3d& T, const Matrix6d& information);

/** Covariance over (rho, phi) of an MRPT Gaussian. */
Matrix6d localCovariance(const mrpt::poses::CPose3DPDFGaussian& pdf);
/** Information over (rho, phi) of an MRPT Gaussian in information form. */
Matrix6d localInformation(const mrpt::poses::CPose3DPDFGaussianInf& pdf);
}  // namespace posidonia
