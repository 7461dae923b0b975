#include <posidonia/base/error.h>
#include <posidonia/eval/alignment.h>
#include <posidonia/eval/path.h>

#include <cmath>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

std::string alignmentName(EAlignment kind)
{
	static const std::array<std::string, 4> names{"unaligned", "origin", "yaw_position", "se3"};
	return names[static_cast<size_t>(kind)];
}

std::string alignmentTitle(EAlignment kind)
{
	static const std::array<std::string, 4> titles{
		"unaligned", "origin aligned", "yaw+position aligned", "SE(3) aligned"};
	return titles[static_cast<size_t>(kind)];
}

namespace
{
/** What the least-squares rotations need: centroids, and C = sum (truth - mean)(est - mean)^T. */
struct TMoments
{
	Vector3d mean_truth{0, 0, 0}, mean_est{0, 0, 0};
	Matrix3d C{Matrix3d::Zero()};
};

TMoments moments(const TAssociation& poses)
{
	TMoments m;
	const double n = static_cast<double>(poses.size());
	for (const auto& p : poses) {
		m.mean_truth += p.T_truth_body.translation() / n;
		m.mean_est += p.T_est_body.translation() / n;
	}
	for (const auto& p : poses)
		m.C += (p.T_truth_body.translation() - m.mean_truth) *
			   (p.T_est_body.translation() - m.mean_est).transpose();
	return m;
}

/** argmax over Rz(yaw) of trace(Rz^T C), closed form. */
Matrix3d bestYaw(const Matrix3d& C)
{
	const double yaw = std::atan2(C(1, 0) - C(0, 1), C(0, 0) + C(1, 1));
	return Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
}

/** argmax over rotations of trace(R^T C): Umeyama 1991, eqs. 40-43 (the sign keeps det R = 1). */
Matrix3d bestRotation(const Matrix3d& C)
{
	const Eigen::JacobiSVD<Matrix3d> svd(C, Eigen::ComputeFullU | Eigen::ComputeFullV);
	const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1 : 1;
	return svd.matrixU() * Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

Isometry3d rotationThenCentroids(const Matrix3d& R, const TMoments& m)
{
	Isometry3d T = Isometry3d::Identity();
	T.linear() = R;
	T.translation() = m.mean_truth - R * m.mean_est;
	return T;
}
}  // namespace

Isometry3d align(EAlignment kind, const TAssociation& poses)
{
	if (poses.empty())
		throw CError("alignment", "no associated poses", "check the stamps of both trajectories");
	if (kind == EAlignment::None) return Isometry3d::Identity();
	if (kind == EAlignment::Origin) return poses[0].T_truth_body * poses[0].T_est_body.inverse();
	const TMoments m = moments(poses);
	return rotationThenCentroids(kind == EAlignment::SE3 ? bestRotation(m.C) : bestYaw(m.C), m);
}
}  // namespace posidonia
