#include <posidonia/eval/absolute_error.h>
#include <posidonia/eval/association.h>
#include <posidonia/report/consistency_plot.h>

#include "report_parts.h"

namespace posidonia
{
using Eigen::Vector3d;

namespace
{
const std::vector<std::array<const char*, 3>>& namedTrajectories()
{
	static const std::vector<std::array<const char*, 3>> names{
		// file, name on the page, label
		{"truth", "truth", "Ground truth"},		 {"odom", "odometry", "Odometry"},
		{"ekf", "ekf", "Navigation filter"},	 {"slam", "slam", "SLAM, causal"},
		{"nodes", "nodes", "SLAM, final nodes"}, {"control", "control", "In control"}};
	return names;
}

/** Poses of truth at a run's stamps; empty where there are none. */
TAssociation associated(const TTrajectory& estimate, const TTrajectory& truth)
{
	return estimate.empty() || truth.empty() ? TAssociation() : associate(estimate, truth);
}

/** The filter's poses only where they are not the odometry's: without the corruptor both are one. */
bool repeatsOdometry(const TRunData& run, const std::string& name)
{
	const TTrajectory &ekf = run.trajectory("ekf"), &odom = run.trajectory("odom");
	return name == "ekf" && ekf.size() == odom.size() && !ekf.empty() &&
		   (ekf.back().T.translation() - odom.back().T.translation()).norm() < 1e-6;
}
}  // namespace

TJson trajectoriesJson(const TRunData& run, const TReportLimits& limits, TJson& notes)
{
	TJson out = TJson::array();
	bool thin = false;
	for (const auto& [file, name, label] : namedTrajectories()) {
		if (run.trajectory(file).empty() || repeatsOdometry(run, file)) continue;
		// Node i is pose i of "nodes": loops point to them.
		const bool all = std::string(file) == "nodes";
		const TTrajectory t = all ? run.trajectory(file) : thinned(run.trajectory(file), limits.poses);
		thin = thin || t.size() < run.trajectory(file).size();
		const auto position = [&](int axis) {
			return column(t, 4, [axis](const TStampedPose& p) { return p.T.translation()[axis]; });
		};
		const auto angle = [&](int k) {
			return column(t, 4, [k](const TStampedPose& p) { return yawPitchRoll(p.T.linear())[k]; });
		};
		out.push_back(
			{{"name", name},
			 {"label", label},
			 {"t", column(t, 3, [&](const TStampedPose& p) { return p.stamp - run.info.start; })},
			 {"n", position(0)},
			 {"e", position(1)},
			 {"d", position(2)},
			 {"roll", angle(2)},
			 {"pitch", angle(1)},
			 {"yaw", angle(0)}});
	}
	if (thin)
		notes.push_back(
			"Trajectories are thinned to " + std::to_string(limits.poses) +
			" poses each; the .tum files of the run folder hold all.");
	return out;
}

TJson errorsJson(const TRunData& run, const TReportLimits& limits)
{
	TJson out = TJson::array();
	for (const auto& [file, name, label] : namedTrajectories()) {
		if (std::string(file) == "truth" || repeatsOdometry(run, file)) continue;
		const TAssociation pairs = associated(run.trajectory(file), run.trajectory("truth"));
		if (pairs.empty()) continue;
		const auto errors = thinned(absoluteError(pairs, EAlignment::None).poses, limits.poses);
		out.push_back(
			{{"name", name},
			 {"label", label},
			 {"t", column(errors, 3, [&](const TPoseError& e) { return e.stamp - run.info.start; })},
			 {"distance", column(errors, 3, [](const TPoseError& e) { return e.distance; })},
			 {"error", column(errors, 5, [](const TPoseError& e) { return e.translation; })}});
	}
	return out;
}

TJson consistencyJson(const TRunData& run, const TReportLimits& limits)
{
	const auto all = judgedNodes(run);
	if (all.empty()) return nullptr;
	double sum = 0;
	for (const TJudgedNode& j : all)
		sum += j.nees / 3;
	const auto shown = thinned(all, limits.poses);
	TJson out{
		{"node", column(shown, 0, [](const TJudgedNode& j) { return double(j.node); })},
		{"t", column(shown, 3, [](const TJudgedNode& j) { return j.t; })}};
	const char* const axes[] = {"n", "e", "d"};
	for (int k = 0; k < 3; k++) {
		out[std::string("error_") + axes[k]] =
			column(shown, 6, [k](const TJudgedNode& j) { return j.error[k]; });
		out[std::string("sigma_") + axes[k]] =
			column(shown, 6, [k](const TJudgedNode& j) { return j.sigma[k]; });
	}
	out["nees"] = column(shown, 3, [](const TJudgedNode& j) { return j.nees; });
	out["anees"] = rounded(sum / double(all.size()), 4);
	return out;
}

namespace
{
/** Rows of control.csv that the page shows. */
struct TControlRows
{
	const TNumberTable& table;
	std::vector<size_t> rows;

	TControlRows(const TNumberTable& t, size_t most) : table(t)
	{
		for (size_t k = 0; k < t.column("t").size(); k++)
			rows.push_back(k);
		rows = thinned(rows, most);
	}
	TJson of(const std::string& name, int decimals = 4) const
	{
		const auto& values = table.column(name);
		return column(rows, decimals, [&](size_t k) { return values[k]; });
	}
	TJson poseError() const
	{
		const auto &n = table.column("n"), &e = table.column("e"), &d = table.column("d"),
				   &tn = table.column("true_n"), &te = table.column("true_e"), &td = table.column("true_d");
		return column(
			rows, 5, [&](size_t k) { return Vector3d(n[k] - tn[k], e[k] - te[k], d[k] - td[k]).norm(); });
	}
};

TJson curve(const char* label, const TJson& values, const char* role)
{
	return {{"label", label}, {"values", values}, {"role", role}};
}
TJson plot(const char* title, const TControlRows& rows, const char* unit, const TJson& series)
{
	return {
		{"title", title},
		{"x", {{"label", "time [s]"}, {"values", rows.of("t", 2)}}},
		{"y_label", unit},
		{"series", series}};
}
}  // namespace

TJson plotsJson(const TRunData& run, const TReportLimits& limits)
{
	TJson out = TJson::array();
	if (!run.control) return out;
	const TControlRows rows(*run.control, limits.poses);
	out.push_back(plot(
		"Steering: true cross-track error, and error of the pose in control", rows, "[m]",
		TJson::array(
			{curve("cross-track", rows.of("cross_track"), "odometry"),
			 curve("pose in control", rows.poseError(), "slam")})));
	out.push_back(plot(
		"Depth: true and wanted", rows, "[m]",
		TJson::array(
			{curve("true", rows.of("true_d"), "truth"), curve("wanted", rows.of("depth_ref"), "slam")})));
	out.push_back(plot(
		"Commands before the limiters", rows, "surge [m/s], yaw rate [rad/s]",
		TJson::array(
			{curve("surge", rows.of("surge_cmd"), "slam"),
			 curve("yaw rate", rows.of("yaw_rate_cmd"), "odometry")})));
	out.push_back(plot(
		"Thruster set-points", rows, "[-1, 1]",
		TJson::array(
			{curve("starboard", rows.of("starboard"), "truth"), curve("port", rows.of("port"), "odometry"),
			 curve("heave", rows.of("heave"), "slam")})));
	return out;
}
}  // namespace posidonia
