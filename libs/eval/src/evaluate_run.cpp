#include <posidonia/eval/evaluate_run.h>
#include <posidonia/eval/path.h>

#include <cmath>

namespace posidonia
{
namespace
{
constexpr double kDegrees = 180 / M_PI;

void addStatistics(
	TMetrics& rows, const std::string& prefix, const std::string& unit, const TStatistics& s,
	double scale = 1)
{
	rows.push_back({prefix + ".mean", unit, scale * s.mean});
	rows.push_back({prefix + ".rmse", unit, scale * s.rmse});
	rows.push_back({prefix + ".median", unit, scale * s.median});
	rows.push_back({prefix + ".max", unit, scale * s.max});
	rows.push_back({prefix + ".min", unit, scale * s.min});
	rows.push_back({prefix + ".std", unit, scale * s.std});
}

void addAbsolute(TMetrics& rows, const std::string& prefix, const TAbsoluteError& e)
{
	const std::string name = prefix + ".ate." + alignmentName(e.alignment);
	addStatistics(rows, name, "m", e.translation);
	rows.push_back({name + ".sse", "m^2", e.translation.sse});
	rows.push_back({name + ".rotation.mean", "deg", kDegrees * e.rotation.mean});
	rows.push_back({name + ".rotation.rmse", "deg", kDegrees * e.rotation.rmse});
	rows.push_back({name + ".rotation.max", "deg", kDegrees * e.rotation.max});
}

void addRelative(
	TMetrics& rows, const std::string& prefix, const TRelativeError& e, const TRelativeErrorOptions& options)
{
	const std::string name = prefix + ".rpe";
	rows.push_back({name + ".delta", options.unit, options.delta});
	rows.push_back({name + ".pieces", "", static_cast<double>(e.translation.count)});
	if (e.translation.count == 0) return;
	addStatistics(rows, name, "m", e.translation);
	rows.push_back({name + ".rotation.mean", "deg", kDegrees * e.rotation.mean});
	rows.push_back({name + ".rotation.rmse", "deg", kDegrees * e.rotation.rmse});
	rows.push_back({name + ".rotation.max", "deg", kDegrees * e.rotation.max});
	if (e.drift.count > 0) rows.push_back({name + ".drift.mean", "%", 100 * e.drift.mean});
}

TMetrics runMetrics(
	const std::string& prefix, const TRunEvaluation& run, size_t estimated,
	const TRelativeErrorOptions& relative)
{
	TMetrics rows;
	rows.push_back({prefix + ".poses", "", static_cast<double>(estimated)});
	rows.push_back({prefix + ".poses_with_truth", "", static_cast<double>(run.poses.size())});
	for (const auto& error : run.absolute)
		addAbsolute(rows, prefix, error);
	rows.push_back({prefix + ".length", "m", run.length});
	rows.push_back({prefix + ".truth_length", "m", run.truth_length});
	rows.push_back({prefix + ".truth_length_full_rate", "m", run.truth_length_full});
	for (const auto& error : run.absolute)
		rows.push_back({prefix + ".end_error." + alignmentName(error.alignment), "m", error.endError()});
	addRelative(rows, prefix, run.relative, relative);
	return rows;
}
}  // namespace

TRunEvaluation evaluateRun(
	const std::string& prefix, const TTrajectory& estimate, const TTrajectory& truth,
	const TEvaluationOptions& options)
{
	TRunEvaluation run;
	run.poses = associate(estimate, truth, options.association);
	for (EAlignment kind : kAlignments)
		run.absolute.push_back(absoluteError(run.poses, kind));
	run.relative = relativeError(run.poses, options.relative);
	run.length = travelled(estimatedPositions(run.poses)).back();
	run.truth_length = travelled(truePositions(run.poses)).back();
	run.truth_length_full = pathLength(truth, run.poses.front().stamp, run.poses.back().stamp);
	run.metrics = runMetrics(prefix, run, estimate.size(), options.relative);
	return run;
}
}  // namespace posidonia
