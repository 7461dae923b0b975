#include <posidonia/base/error.h>
#include <posidonia/report/svg_plot.h>
#include <posidonia/report/trajectory_plot.h>

namespace posidonia
{
using Eigen::Vector2d;

namespace
{
std::vector<Vector2d> northEast(const TTrajectory& trajectory)
{
	std::vector<Vector2d> points;
	for (const auto& pose : trajectory)
		points.push_back(pose.T.translation().head<2>());
	return points;
}

std::vector<Vector2d> northEast(const std::vector<TSegment>& segments)
{
	std::vector<Vector2d> points;
	for (const auto& [from, to] : segments) {
		points.push_back(from.head<2>());
		points.push_back(to.head<2>());
	}
	return points;
}

Eigen::Vector3d position(const TTrajectory& nodes, std::uint64_t id)
{
	if (id >= nodes.size())
		throw CError(
			"loops",
			"node " + std::to_string(id) + " is beyond the " + std::to_string(nodes.size()) + " nodes",
			"are loops.csv and nodes.tum of the same run?");
	return nodes[id].T.translation();
}

std::vector<TSegment> segmentsOf(const std::vector<TLoopRow>& rows, const TTrajectory& nodes, bool rejected)
{
	std::vector<TSegment> segments;
	for (const auto& row : rows)
		if (row.accepted() && !row.consecutive() && row.rejected() == rejected)
			segments.emplace_back(position(nodes, row.from), position(nodes, row.to));
	return segments;
}
}  // namespace

std::string plotTrajectories(const TTrajectoryPlot& plot)
{
	// The broad truth first: what lies on it stays visible.
	const std::vector<TCurve> curves{
		{"loop closings (" + std::to_string(plot.loops.size()) + ")", styles::loops(), northEast(plot.loops),
		 true},
		{"truth", styles::truth(), northEast(plot.truth)},
		{"odometry", styles::odometry(), northEast(plot.odometry)},
		{"SLAM", styles::slam(), northEast(plot.slam)},
		{"loops turned down (" + std::to_string(plot.rejected_loops.size()) + ")", styles::rejectedLoops(),
		 northEast(plot.rejected_loops), true}};
	TPlotSize size;
	size.height = 560;
	size.equal_scale = true;
	return svgPlot({plot.title, "x north [m]", "y east [m]"}, curves, size);
}

std::vector<TSegment> loopSegments(const std::vector<TLoopRow>& rows, const TTrajectory& nodes)
{
	return segmentsOf(rows, nodes, false);
}

std::vector<TSegment> rejectedLoopSegments(const std::vector<TLoopRow>& rows, const TTrajectory& nodes)
{
	return segmentsOf(rows, nodes, true);
}
}  // namespace posidonia
