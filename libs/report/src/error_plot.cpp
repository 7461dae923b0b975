#include <posidonia/report/error_plot.h>
#include <posidonia/report/svg_plot.h>

namespace posidonia
{
namespace
{
std::vector<Eigen::Vector2d> alongTheRoute(const std::vector<TPoseError>& errors)
{
	std::vector<Eigen::Vector2d> points;
	for (const auto& e : errors)
		points.emplace_back(e.distance, e.translation);
	return points;
}
}  // namespace

std::string plotErrors(const TErrorPlot& plot)
{
	const std::vector<TCurve> curves{
		{"odometry", styles::odometry(), alongTheRoute(plot.odometry)},
		{"SLAM", styles::slam(), alongTheRoute(plot.slam)}};
	TPlotSize size;
	size.height = 300;
	size.vertical_from_zero = true;
	return svgPlot({plot.title, "distance travelled [m]", "3D error [m]"}, curves, size);
}
}  // namespace posidonia
