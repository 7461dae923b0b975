#include <posidonia/eval/association.h>
#include <posidonia/report/consistency_plot.h>
#include <posidonia/report/svg_plot.h>

namespace posidonia
{
using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<TJudgedNode> judgedNodes(const TRunData& run)
{
	std::vector<TJudgedNode> out;
	if (run.trajectory("nodes").empty() || !run.hasTruth()) return out;
	for (const TAssociatedPose& pair : associate(run.trajectory("nodes"), run.trajectory("truth"))) {
		if (pair.index >= run.nodes.size()) continue;
		const Eigen::Matrix3d P = run.nodes[pair.index].covariance.topLeftCorner<3, 3>();
		const Vector3d e = pair.T_est_body.translation() - pair.T_truth_body.translation();
		if (P.llt().info() != Eigen::Success) continue;	 // a root that is held fixed has none
		out.push_back(
			{int(pair.index), pair.stamp - run.info.start, e, P.diagonal().cwiseSqrt(),
			 e.dot(P.llt().solve(e))});
	}
	return out;
}

namespace
{
const TPlotSize kWide{800, 300};

template <class F>
std::vector<Vector2d> overTime(const std::vector<TJudgedNode>& nodes, const F& value)
{
	std::vector<Vector2d> points;
	for (const TJudgedNode& node : nodes)
		points.emplace_back(node.t, value(node));
	return points;
}
std::vector<Vector2d> level(const std::vector<TJudgedNode>& nodes, double value)
{
	return {{nodes.front().t, value}, {nodes.back().t, value}};
}
}  // namespace

std::string plotNodeErrors(const std::vector<TJudgedNode>& nodes)
{
	const TLineStyle styles[] = {styles::slam(), styles::odometry(), styles::truth()};
	const char* const names[] = {"north", "east", "down"};
	std::vector<TCurve> curves;
	for (int k = 0; k < 3; k++) {
		TLineStyle bound = styles[k];
		bound.width = 0.8, bound.dash = "2 3";
		const auto error = [k](const TJudgedNode& n) { return n.error[k]; };
		curves.push_back({names[k], styles[k], overTime(nodes, error)});
		for (const double side : {3.0, -3.0}) {
			const auto sigma = [k, side](const TJudgedNode& n) { return side * n.sigma[k]; };
			curves.push_back(
				{side > 0 ? std::string(names[k]) + ", 3 sigma" : "", bound, overTime(nodes, sigma)});
		}
	}
	return svgPlot({"Errors of the final nodes", "time [s]", "[m]"}, curves, kWide);
}

std::string plotNees(const std::vector<TJudgedNode>& nodes)
{
	constexpr double kLow = 0.215795, kHigh = 9.348404;	 // chi-square, 3 degrees of freedom, 2.5 and 97.5 %
	TLineStyle band = styles::truth();
	band.width = 1, band.dash = "6 4";
	const auto nees = [](const TJudgedNode& n) { return n.nees; };
	std::vector<TCurve> curves;
	if (!nodes.empty())
		curves = {
			{"NEES of the position", styles::slam(), overTime(nodes, nees)},
			{"95 % of an honest filter's", band, level(nodes, kLow)},
			{"", band, level(nodes, kHigh)}};
	return svgPlot({"Honesty of the final nodes", "time [s]", "NEES, 3 degrees of freedom"}, curves, kWide);
}
}  // namespace posidonia
