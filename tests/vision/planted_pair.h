#pragma once

#include <posidonia/geometry/se3.h>
#include <posidonia/vision/key_frame.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace posidonia::testing
{
/** Two key frames of pure geometry: points of a nearly flat floor seen by both, noise as stated. */
struct TPlantedPair
{
	TKeyFrame a, b;
	Eigen::Isometry3d T_a_b;
	std::vector<std::pair<int, int>> truth;	 ///< Right matches (the first ones of either key frame)
};

struct TPlan
{
	int points{150};
	double outlier_share{0};  ///< Of the matches
	double noise{1};		  ///< Times the stated sigmas
	double relief{0.1};		  ///< [m]
	/** Left pixels of a are drawn in this box round the middle [px]. */
	double half_width{300}, half_height{220};
};

inline cv::Mat randomDescriptors(int rows, std::mt19937& rng)
{
	cv::Mat d(rows, 128, CV_8U);
	for (int i = 0; i < rows * 128; i++)
		d.data[i] = static_cast<uint8_t>(rng() % 200);
	return d;
}

inline TPlantedPair plantedPair(const Eigen::Isometry3d& T_a_b, const TPlan& plan, std::mt19937& rng)
{
	const TStereoCamera camera;
	std::normal_distribution<double> normal;
	std::uniform_real_distribution<double> unit(-1, 1);
	TPlantedPair pair;
	pair.T_a_b = T_a_b;
	const auto observe = [&](const Eigen::Vector3d& p, double octave) {
		const double uv = 0.07 * std::pow(1.47, octave), d = 0.03;
		const Eigen::Vector3d clean = camera.project(p);
		const double n1 = normal(rng), n2 = normal(rng), n3 = normal(rng), k = plan.noise;
		const Eigen::Vector3d uvd(
			clean.x() + k * uv * n1, clean.y() + k * uv * n2, clean.x() - clean.z() + k * d * n3);
		return makeStereoPoint(camera, uvd, uv, d, octave);
	};
	const auto inView = [&](const Eigen::Vector3d& p) {
		const Eigen::Vector3d q = camera.project(p);
		return p.z() > 0.3 && q.x() > 0 && q.x() < camera.width && q.y() > 0 && q.y() < camera.height &&
			   q.z() > 0;
	};
	const auto floorPoint = [&] {
		const double u = unit(rng) * plan.half_width, v = unit(rng) * plan.half_height;
		const double z = 2.5 + plan.relief * unit(rng);
		return Eigen::Vector3d(u * z / camera.fx, v * z / camera.fy, z);
	};
	const int wrong = static_cast<int>(std::lround(plan.outlier_share * plan.points));
	for (int tries = 0; tries < 100000 && static_cast<int>(pair.a.size()) < plan.points; tries++) {
		const Eigen::Vector3d p = floorPoint(), in_b = T_a_b.inverse() * p;
		if (!inView(p) || !inView(in_b)) continue;
		const double octave = 2 * std::abs(unit(rng));
		const int i = static_cast<int>(pair.a.size());
		const bool outlier = i >= plan.points - wrong;
		pair.a.points.push_back(observe(p, octave));
		pair.b.points.push_back(observe(outlier ? floorPoint() : in_b, octave));
		if (!outlier) pair.truth.emplace_back(i, i);
	}
	pair.a.descriptors = randomDescriptors(static_cast<int>(pair.a.size()), rng);
	pair.b.descriptors = pair.a.descriptors.clone();
	return pair;
}
}  // namespace posidonia::testing
