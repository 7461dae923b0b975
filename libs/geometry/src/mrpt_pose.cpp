#include <posidonia/geometry/mrpt_pose.h>

namespace posidonia
{
using Eigen::Isometry3d;

mrpt::poses::CPose3D toMrpt(const Isometry3d& T)
{
	mrpt::math::CMatrixDouble44 H;
	for (int r = 0; r < 4; r++)
		for (int c = 0; c < 4; c++)
			H(r, c) = T.matrix()(r, c);
	return mrpt::poses::CPose3D(H);
}

Isometry3d fromMrpt(const mrpt::poses::CPose3D& T)
{
	Isometry3d U = Isometry3d::Identity();
	const auto& R = T.getRotationMatrix();
	for (int r = 0; r < 3; r++)
		for (int c = 0; c < 3; c++)
			U.linear()(r, c) = R(r, c);
	U.translation() << T.x(), T.y(), T.z();
	return U;
}

Matrix6d mrptFromLocalJacobian(const Isometry3d& T)
{
	// Body rates to Euler rates: phi = (roll', pitch', yaw') mapped by the standard z-y-x kinematics.
	const Eigen::Vector3d ypr = yawPitchRoll(T.linear());
	const double sr = std::sin(ypr[2]), cr = std::cos(ypr[2]);
	const double cp = std::cos(ypr[1]), tp = std::tan(ypr[1]);
	Eigen::Matrix3d E;
	E << 0, sr / cp, cr / cp,  // yaw
		0, cr, -sr,			   // pitch
		1, sr * tp, cr * tp;   // roll
	Matrix6d J = Matrix6d::Zero();
	J.topLeftCorner<3, 3>() = T.linear();
	J.bottomRightCorner<3, 3>() = E;
	return J;
}

namespace
{
template <class TO, class FROM>
void copy66(TO& to, const FROM& from)
{
	for (int r = 0; r < 6; r++)
		for (int c = 0; c < 6; c++)
			to(r, c) = from(r, c);
}
}  // namespace

mrpt::poses::CPose3DPDFGaussian toMrptGaussian(const Isometry3d& T, const Matrix6d& cov)
{
	const Matrix6d J = mrptFromLocalJacobian(T);
	mrpt::poses::CPose3DPDFGaussian pdf(toMrpt(T));
	copy66(pdf.cov, Matrix6d(J * cov * J.transpose()));
	return pdf;
}

mrpt::poses::CPose3DPDFGaussianInf toMrptGaussianInf(const Isometry3d& T, const Matrix6d& information)
{
	const Matrix6d L = mrptFromLocalJacobian(T).inverse();
	mrpt::poses::CPose3DPDFGaussianInf pdf(toMrpt(T));
	copy66(pdf.cov_inv, Matrix6d(L.transpose() * information * L));
	return pdf;
}

Matrix6d localCovariance(const mrpt::poses::CPose3DPDFGaussian& pdf)
{
	const Matrix6d L = mrptFromLocalJacobian(fromMrpt(pdf.mean)).inverse();
	Matrix6d cov;
	copy66(cov, pdf.cov);
	return L * cov * L.transpose();
}

Matrix6d localInformation(const mrpt::poses::CPose3DPDFGaussianInf& pdf)
{
	const Matrix6d J = mrptFromLocalJacobian(fromMrpt(pdf.mean));
	Matrix6d information;
	copy66(information, pdf.cov_inv);
	return J.transpose() * information * J;
}
}  // namespace posidonia
