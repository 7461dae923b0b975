#include <posidonia/geometry/se3.h>

#include <cmath>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d skew(const Vector3d& a)
{
	Matrix3d S;
	S << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
	return S;
}

namespace
{
/** sin(x)/x, (1-cos x)/x^2, (x-sin x)/x^3 by angle squared, with series below 1e-4 rad^2. */
struct TRodrigues
{
	double a, b, c;
	explicit TRodrigues(double x2)
	{
		if (x2 < 1e-4) {
			a = 1 - x2 / 6 * (1 - x2 / 20 * (1 - x2 / 42));
			b = 0.5 * (1 - x2 / 12 * (1 - x2 / 30 * (1 - x2 / 56)));
			c = 1.0 / 6 * (1 - x2 / 20 * (1 - x2 / 42 * (1 - x2 / 72)));
			return;
		}
		const double x = std::sqrt(x2);
		a = std::sin(x) / x;
		b = (1 - std::cos(x)) / x2;
		c = (x - std::sin(x)) / (x2 * x);
	}
};
}  // namespace

Matrix3d expSO3(const Vector3d& phi)
{
	const TRodrigues k(phi.squaredNorm());
	const Matrix3d S = skew(phi);
	return Matrix3d::Identity() + k.a * S + k.b * S * S;
}

Vector3d logSO3(const Matrix3d& R)
{
	// Through the quaternion: well conditioned at every angle.
	Eigen::Quaterniond q(R);
	if (q.w() < 0) q.coeffs() *= -1;
	const double n = q.vec().norm();
	if (n < 1e-10) return 2 * q.vec();
	return 2 * std::atan2(n, q.w()) / n * q.vec();
}

Matrix3d rightJacobianSO3(const Vector3d& phi)
{
	const TRodrigues k(phi.squaredNorm());
	const Matrix3d S = skew(phi);
	return Matrix3d::Identity() - k.b * S + k.c * S * S;
}

Matrix3d rightJacobianInverseSO3(const Vector3d& phi)
{
	const double x2 = phi.squaredNorm();
	const Matrix3d S = skew(phi);
	double d = 1.0 / 12 + x2 / 720;
	if (x2 > 1e-4) {
		const double x = std::sqrt(x2);
		d = 1 / x2 - (1 + std::cos(x)) / (2 * x * std::sin(x));
	}
	return Matrix3d::Identity() + 0.5 * S + d * S * S;
}

Isometry3d retract(const Isometry3d& T, const Vector6d& d)
{
	Isometry3d U = Isometry3d::Identity();
	U.linear() = T.linear() * expSO3(d.tail<3>());
	U.translation() = T.translation() + T.linear() * d.head<3>();
	return U;
}

Vector6d localCoordinates(const Isometry3d& T, const Isometry3d& U)
{
	Vector6d d;
	d.head<3>() = T.linear().transpose() * (U.translation() - T.translation());
	d.tail<3>() = logSO3(T.linear().transpose() * U.linear());
	return d;
}

Matrix6d adjoint(const Isometry3d& T)
{
	Matrix6d A = Matrix6d::Zero();
	A.topLeftCorner<3, 3>() = T.linear();
	A.bottomRightCorner<3, 3>() = T.linear();
	A.topRightCorner<3, 3>() = skew(T.translation()) * T.linear();
	return A;
}

Matrix6d composeCovariance(const Matrix6d& cov_a_b, const Isometry3d& T_b_c, const Matrix6d& cov_b_c)
{
	return changeFrameCovariance(cov_a_b, T_b_c) + cov_b_c;
}

Matrix6d inverseCovariance(const Isometry3d& T, const Matrix6d& cov)
{
	const Matrix6d A = adjoint(T);
	return A * cov * A.transpose();
}

Matrix6d changeFrameCovariance(const Matrix6d& cov_T, const Isometry3d& Y)
{
	const Matrix6d A = adjoint(Y.inverse());
	return A * cov_T * A.transpose();
}

Matrix3d rotationFromYawPitchRoll(double yaw, double pitch, double roll)
{
	using Eigen::AngleAxisd;
	return (AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
			AngleAxisd(roll, Vector3d::UnitX()))
		.toRotationMatrix();
}

Vector3d yawPitchRoll(const Matrix3d& R)
{
	const double pitch = std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0)));
	return {std::atan2(R(1, 0), R(0, 0)), pitch, std::atan2(R(2, 1), R(2, 2))};
}

Isometry3d orthonormalized(const Isometry3d& T)
{
	Isometry3d U = T;
	U.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
	return U;
}

double wrapAngle(double radians)
{
	const double x = std::remainder(radians, 2 * M_PI);
	return x <= -M_PI ? M_PI : x;
}

bool isPositiveDefinite(const Matrix6d& M)
{
	if (!M.allFinite()) return false;
	if ((M - M.transpose()).norm() > 1e-6 * M.norm()) return false;
	return Eigen::LLT<Matrix6d>(M).info() == Eigen::Success;
}
}  // namespace posidonia
