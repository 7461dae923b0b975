#include <posidonia/eval/association.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>

#include "report_parts.h"

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector2d;

namespace
{
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/** By how much two relative poses differ: metres and radians. */
Vector2d difference(const Isometry3d& a, const Isometry3d& b)
{
	const Isometry3d d = a.inverse() * b;
	return {d.translation().norm(), Eigen::AngleAxisd(d.linear()).angle()};
}

/** T_from_to by the poses of two nodes. */
Isometry3d between(const TTrajectory& nodes, const TLoopRow& row)
{
	return nodes[row.from].T.inverse() * nodes[row.to].T;
}

bool measuredWithin(const TTrajectory& nodes, const TLoopRow& row)
{
	return row.T_from_to && row.from < nodes.size() && row.to < nodes.size();
}

const TMatchesRow* matchesOf(const TRunData& run, const TLoopRow& row)
{
	const auto found = run.matches.find({int(row.from), int(row.to)});
	return row.accepted() && found != run.matches.end() ? &found->second : nullptr;
}

/** The true poses at the nodes, by node; empty where there is no truth for all of them. */
TTrajectory truthAtNodes(const TRunData& run)
{
	if (!run.hasTruth() || run.trajectory("nodes").empty()) return {};
	TTrajectory out;
	for (const TAssociatedPose& pair : associate(run.trajectory("nodes"), run.trajectory("truth")))
		out.push_back({pair.stamp, pair.T_truth_body});
	return out.size() == run.trajectory("nodes").size() ? out : TTrajectory();
}

}  // namespace

Vector2d residualOf(const TRunData& run, const TLoopRow& row)
{
	const TTrajectory& nodes = run.trajectory("nodes");
	return measuredWithin(nodes, row) ? difference(*row.T_from_to, between(nodes, row))
									  : Vector2d(kNone, kNone);
}

std::vector<size_t> byResidual(const TRunData& run, const std::vector<TLoopRow>& rows)
{
	std::vector<double> residuals;
	for (const TLoopRow& row : rows) {
		const double r = residualOf(run, row).x();
		residuals.push_back(std::isfinite(r) ? r : -1);
	}
	std::vector<size_t> order(rows.size());
	std::iota(order.begin(), order.end(), size_t(0));
	std::stable_sort(
		order.begin(), order.end(), [&](size_t a, size_t b) { return residuals[a] > residuals[b]; });
	return order;
}

std::vector<TLoopRow> loopsShown(const TRunData& run, const TReportLimits& limits, TJson& notes)
{
	std::vector<TLoopRow> tried;
	for (const TLoopRow& row : run.loops)
		if (row.tried()) tried.push_back(row);
	if (tried.size() <= limits.loops) return tried;
	notes.push_back(
		"The list shows " + std::to_string(limits.loops) + " of " + std::to_string(tried.size()) +
		" pairs that were tried: half those with the largest residuals, half spread evenly; loops.csv holds "
		"all.");
	std::vector<size_t> order = byResidual(run, tried);
	const size_t half = limits.loops / 2;
	std::vector<size_t> picked(order.begin(), order.begin() + long(half));
	const auto others =
		thinned(std::vector<size_t>(order.begin() + long(half), order.end()), limits.loops - half);
	picked.insert(picked.end(), others.begin(), others.end());
	std::sort(picked.begin(), picked.end());
	std::vector<TLoopRow> shown;
	for (const size_t k : picked)
		shown.push_back(tried[k]);
	return shown;
}

namespace
{
/** Matches as bytes, four a match: u, v in both pictures, scaled to 0 ... 255 over width and height. */
TJson matchLines(const TMatchesRow& row, const TStereoCamera& camera, size_t most)
{
	std::vector<unsigned char> bytes;
	const auto add = [&](const Vector2d& p) {
		bytes.push_back(cv::saturate_cast<uchar>(255 * p.x() / camera.width));
		bytes.push_back(cv::saturate_cast<uchar>(255 * p.y() / camera.height));
	};
	for (const auto& [a, b] : thinned(row.points, most)) {
		add(a);
		add(b);
	}
	return base64(bytes);
}
}  // namespace

TJson loopsJson(const TRunData& run, const std::vector<TLoopRow>& shown, const TReportLimits& limits)
{
	const TTrajectory truth = truthAtNodes(run);
	const auto whole = [&](const auto& value) { return column(shown, 0, value); };
	TJson out{
		{"from", whole([](const TLoopRow& r) { return double(r.from); })},
		{"to", whole([](const TLoopRow& r) { return double(r.to); })}};
	TJson kinds = TJson::array(), statuses = TJson::array(), points = TJson::array();
	for (const TLoopRow& row : shown) {
		kinds.push_back(row.kind);
		statuses.push_back(row.status);
		const TMatchesRow* matches = matchesOf(run, row);
		points.push_back(
			matches && run.camera ? matchLines(*matches, run.camera->camera, limits.match_lines)
								  : TJson(nullptr));
	}
	out["kind"] = kinds;
	out["status"] = statuses;
	out["matches"] = whole([](const TLoopRow& r) { return double(r.matches); });
	out["inliers"] = whole([](const TLoopRow& r) { return double(r.inliers); });
	out["rmse_px"] = column(shown, 3, [](const TLoopRow& r) { return r.rmse; });
	out["residual_m"] = column(shown, 5, [&](const TLoopRow& r) { return residualOf(run, r).x(); });
	out["residual_deg"] =
		column(shown, 4, [&](const TLoopRow& r) { return residualOf(run, r).y() * 180 / M_PI; });
	out["chi2"] = column(shown, 2, [&](const TLoopRow& r) {
		const TMatchesRow* matches = matchesOf(run, r);
		return matches ? matches->chi2 : kNone;
	});
	out["weight"] = column(shown, 3, [](const TLoopRow& r) { return r.weight.value_or(kNone); });
	out["error_m"] = column(shown, 4, [&](const TLoopRow& r) {
		return measuredWithin(truth, r) ? difference(*r.T_from_to, between(truth, r)).x() : kNone;
	});
	out["points"] = points;
	return out;
}
}  // namespace posidonia
