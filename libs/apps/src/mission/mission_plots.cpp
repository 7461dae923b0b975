#include <posidonia/apps/mission/mission_plots.h>
#include <posidonia/report/svg_plot.h>

#include <limits>

namespace posidonia
{
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

template <class F>
std::vector<Vector2d> overTime(const std::vector<TControlStep>& steps, const F& value)
{
	std::vector<Vector2d> points;
	for (const TControlStep& step : steps)
		points.emplace_back(step.t, value(step));
	return points;
}
}  // namespace

double trueCrossTrack(const TControlStep& step)
{
	const TLegProgress& leg = step.output.leg;
	if (leg.phase != ELegPhase::RUN && leg.phase != ELegPhase::APPROACH) return kNone;
	const Vector2d along = (leg.end - leg.start).normalized();
	const Vector2d off = step.truth.T_map_body.translation().head<2>() - leg.start;
	return along.x() * off.y() - along.y() * off.x();
}

double controlError(const TControlStep& step)
{
	if (!step.feedback.navigation.valid) return kNone;
	const Vector3d used = step.feedback.navigation.T_map_body.translation();
	return (used - step.truth.T_map_body.translation()).norm();
}

std::string plotMissionErrors(const std::vector<TControlStep>& steps)
{
	TPlotSize size;
	size.width = 800;
	size.height = 300;
	return svgPlot(
		{"Errors in closed loop", "time [s]", "[m]"},
		{{"cross-track error (true)", styles::odometry(), overTime(steps, trueCrossTrack)},
		 {"error of the controllers' pose", styles::slam(), overTime(steps, controlError)}},
		size);
}

std::string plotCommands(const std::vector<TControlStep>& steps)
{
	TPlotSize size;
	size.width = 800;
	size.height = 300;
	const auto surge = [](const TControlStep& s) { return s.output.unlimited.surge; };
	const auto yaw_rate = [](const TControlStep& s) { return s.output.unlimited.yaw_rate; };
	return svgPlot(
		{"Commands before the limiters", "time [s]", "surge [m/s], yaw rate [rad/s]"},
		{{"yaw rate", styles::odometry(), overTime(steps, yaw_rate)},
		 {"surge", styles::slam(), overTime(steps, surge)}},
		size);
}
}  // namespace posidonia
