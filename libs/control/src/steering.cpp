#include <posidonia/control/guidance_command.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
TSteering steer(const Eigen::Vector2d& wish, const Eigen::Vector2d& current, double heading)
{
	const Eigen::Vector2d through_water = wish - current;
	const Eigen::Vector2d bow(std::cos(heading), std::sin(heading));
	return {std::atan2(through_water.y(), through_water.x()), wish.dot(bow)};
}

double alignment(double heading_error)
{
	return std::clamp(1 - (std::abs(heading_error) - 0.3), 0.0, 1.0);
}
}  // namespace posidonia
