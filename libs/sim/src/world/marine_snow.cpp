#include <posidonia/sim/marine_snow.h>
#include <posidonia/sim/random.h>

#include <cmath>
#include <random>

namespace posidonia
{
std::vector<TFlake> drawFlakes(
	const TSnowOptions& options, const TStereoCamera& camera, const Eigen::Isometry3d& T_map_camera,
	uint64_t seed)
{
	std::vector<TFlake> flakes;
	if (options.density == 0 || options.reach <= kNearestFlake) return flakes;
	// The view is a pyramid: its cross-section grows as z^2, the volume as z^3.
	const double section = camera.width / camera.fx * camera.height / camera.fy;
	const double near3 = std::pow(kNearestFlake, 3), far3 = std::pow(options.reach, 3);
	std::mt19937_64 generator(mixed(seed, 0));
	const int count =
		std::poisson_distribution<int>(options.density * section * (far3 - near3) / 3)(generator);
	CNoise draw(mixed(seed, 1));
	for (int i = 0; i < count; i++) {
		const double z = std::cbrt(draw.uniform(near3, far3));
		const double u = draw.uniform(-0.5, camera.width - 0.5), v = draw.uniform(-0.5, camera.height - 0.5);
		const Eigen::Vector3d p(z * (u - camera.cx) / camera.fx, z * (v - camera.cy) / camera.fy, z);
		flakes.push_back({T_map_camera * p, options.size * draw.uniform(0.5, 1.5)});
	}
	return flakes;
}
}  // namespace posidonia
