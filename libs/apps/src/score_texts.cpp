#include <posidonia/apps/score_texts.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/number_text.h>
#include <posidonia/eval/text_table.h>

#include <algorithm>

namespace posidonia
{
namespace
{
constexpr double kDegrees = 180 / M_PI;

std::string metres(double x)
{
	return fixedText(x, 4);
}
std::string degrees(double radians)
{
	return fixedText(kDegrees * radians, 3);
}

std::string absoluteTable(const TRunScores& scores, const std::vector<EAlignment>& alignments)
{
	CTextTable table(
		{"absolute error", "alignment", "mean [m]", "rmse", "median", "max", "min", "std", "sse [m^2]",
		 "at the end", "rotation mean [deg]", "max"});
	for (const auto& [name, run] : scores.trajectories)
		for (const auto& e : run.absolute) {
			if (std::find(alignments.begin(), alignments.end(), e.alignment) == alignments.end()) continue;
			const auto& t = e.translation;
			table.add(
				{name, alignmentTitle(e.alignment), metres(t.mean), metres(t.rmse), metres(t.median),
				 metres(t.max), metres(t.min), metres(t.std), metres(t.sse), metres(e.endError()),
				 degrees(e.rotation.mean), degrees(e.rotation.max)});
		}
	return table.text();
}

std::string relativeTable(const TRunScores& scores)
{
	CTextTable table(
		{"relative error", "over", "pieces", "mean [m]", "rmse", "max", "rotation mean [deg]", "drift [%]"});
	for (const auto& [name, run] : scores.trajectories) {
		const auto delta = std::find_if(
			run.metrics.begin(), run.metrics.end(),
			[prefix = name](const TMetric& row) { return row.what == prefix + ".rpe.delta"; });
		const auto& e = run.relative;
		const bool any = e.translation.count > 0;
		const auto text = [&](const std::string& number) { return any ? number : std::string("-"); };
		table.add(
			{name, significantText(delta->value, 6) + " " + delta->unit, std::to_string(e.translation.count),
			 text(metres(e.translation.mean)), text(metres(e.translation.rmse)),
			 text(metres(e.translation.max)), text(degrees(e.rotation.mean)),
			 e.drift.count ? fixedText(100 * e.drift.mean, 3) : "-"});
	}
	return table.text();
}

std::string lengthTable(const TRunScores& scores)
{
	CTextTable table(
		{"length", "estimate [m]", "truth at its stamps [m]", "truth at its own rate [m]", "poses"});
	for (const auto& [name, run] : scores.trajectories)
		table.add(
			{name, fixedText(run.length, 3), fixedText(run.truth_length, 3),
			 fixedText(run.truth_length_full, 3), std::to_string(run.poses.size())});
	return table.text();
}
}  // namespace

std::string scoresText(const TRunScores& scores, const std::vector<EAlignment>& alignments)
{
	std::string text =
		absoluteTable(scores, alignments) + "\n" + relativeTable(scores) + "\n" + lengthTable(scores);
	if (scores.loops) text += "\n" + metricsText(loopMetrics("loops", *scores.loops));
	return text;
}

std::vector<EAlignment> alignmentsOf(const std::string& name)
{
	if (name == "all") return {kAlignments.begin(), kAlignments.end()};
	if (name == "none") return {EAlignment::None};
	for (EAlignment kind : kAlignments)
		if (kind != EAlignment::None && alignmentName(kind) == name) return {kind};
	throw CUsageError(
		"--align " + name, "is no alignment",
		didYouMean(name, {"none", "origin", "yaw_position", "se3", "all"}));
}
}  // namespace posidonia
