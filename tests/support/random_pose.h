#pragma once

#include <posidonia/geometry/se3.h>

#include <random>

namespace posidonia::testing
{
inline Eigen::Vector3d randomVector(std::mt19937& rng, double scale)
{
	std::uniform_real_distribution<double> u(-scale, scale);
	const double x = u(rng), y = u(rng), z = u(rng);
	return {x, y, z};
}

/** Translation within +-`metres`, rotation vector within +-`radians` an axis. */
inline Eigen::Isometry3d randomPose(std::mt19937& rng, double metres, double radians)
{
	Vector6d d;
	d.head<3>() = randomVector(rng, metres);
	d.tail<3>() = randomVector(rng, radians);
	return retract(Eigen::Isometry3d::Identity(), d);
}

/** A random covariance with standard deviations near `sigma`. */
inline Matrix6d randomCovariance(std::mt19937& rng, double sigma)
{
	std::normal_distribution<double> n;
	Matrix6d A;
	for (int i = 0; i < 36; i++)
		A(i) = n(rng);
	return sigma * sigma * (A * A.transpose() / 6 + 0.1 * Matrix6d::Identity());
}
}  // namespace posidonia::testing
