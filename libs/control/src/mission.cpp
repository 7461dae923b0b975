#include <posidonia/base/error.h>
#include <posidonia/control/mission.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
using Eigen::Vector2d;

std::string toString(EStepKind kind)
{
	switch (kind) {
		case EStepKind::GOTO:
			return "goto";
		case EStepKind::SECTION:
			return "section";
		case EStepKind::DIVE:
			return "dive";
		case EStepKind::HOLD:
			return "hold";
		default:
			return "surface";
	}
}

double defaultTimeout(const TStep& step, double distance, double climb)
{
	const double across = std::sqrt(2.0) * distance / step.speed;
	const double down = climb / std::min(0.3, step.vertical_speed);
	return 2 * std::max(across, down) + 30 + step.duration;
}

namespace
{
std::string metres(double x)
{
	char text[32];
	std::snprintf(text, sizeof text, "%.2f m", x);
	return text;
}

void checkInsideCage(const std::string& where, const Vector2d& point, const std::vector<double>& cage)
{
	if (cage.empty()) return;
	if (point.x() >= cage[0] && point.y() >= cage[1] && point.x() <= cage[2] && point.y() <= cage[3]) return;
	throw CError(
		where, "north " + metres(point.x()) + ", east " + metres(point.y()) + " is outside the cage",
		"move the point, or widen [Safety] cage");
}

void checkVertical(const std::string& where, const TStep& step, const TSafetyOptions& limits)
{
	if (step.altitude_mode && step.altitude < limits.min_altitude)
		throw CError(
			where, "altitude " + metres(step.altitude) + " is under [Safety] min_altitude", "fly higher");
	if (!step.altitude_mode && (step.depth > limits.max_depth || step.depth < 0))
		throw CError(
			where, "depth " + metres(step.depth) + " is not between 0 and [Safety] max_depth",
			"change the depth or the limit");
}
}  // namespace

void checkMission(const TMission& mission, const TSafetyOptions& limits, const Vector2d& start)
{
	if (mission.steps.empty())
		throw CError(mission.file, "the mission has no steps", "write [Step.1], [Step.2] ...");
	if (!limits.cage.empty() && limits.cage.size() != 4)
		throw CError("[Safety] cage", "must be 4 numbers", "write min north, min east, max north, max east");
	checkInsideCage(mission.file + ": start of the mission", start, limits.cage);
	Vector2d here = start;
	for (const TStep& step : mission.steps) {
		const std::string where = mission.file + ": " + step.name;
		checkVertical(where, step, limits);
		if (!step.has_end) continue;
		checkInsideCage(where, step.end, limits.cage);
		const double distance = (step.end - here).norm();
		if (distance > mission.options.max_distance)
			throw CError(
				where, "is " + metres(distance) + " from the point before",
				"check the datum, or raise [Mission] max_distance");
		here = step.end;
	}
}
}  // namespace posidonia
