#include <posidonia/base/files.h>
#include <posidonia/eval/association.h>
#include <posidonia/report/consistency_plot.h>
#include <posidonia/report/error_plot.h>
#include <posidonia/report/run_pictures.h>
#include <posidonia/report/trajectory_plot.h>

#include <ostream>

namespace posidonia
{
namespace
{
std::vector<TPoseError> errorsOf(const TRunData& run, const std::string& name)
{
	if (run.trajectory(name).empty() || !run.hasTruth()) return {};
	return absoluteError(associate(run.trajectory(name), run.trajectory("truth")), EAlignment::None).poses;
}

std::string titleOf(const TRunData& run)
{
	return run.paper_experiment ? "Experiment " + std::to_string(run.paper_experiment) : run.info.title;
}
}  // namespace

void writeRunPictures(const TRunData& run, const std::string& folder)
{
	makeFolder(folder);
	const auto write = [&](const char* name, const std::string& svg) {
		writeFileWhole(folder + "/" + name, [&](std::ostream& out) { out << svg; });
	};
	const bool slam = !run.trajectory("nodes").empty();
	const TTrajectory &odometry = run.trajectory("odom"), &nodes = run.trajectory(slam ? "nodes" : "ekf");
	TTrajectoryPlot plot{titleOf(run), odometry, run.trajectory("truth"), nodes, {}, {}};
	if (slam) plot.loops = loopSegments(run.loops, nodes);
	if (slam) plot.rejected_loops = rejectedLoopSegments(run.loops, nodes);
	write("trajectories.svg", plotTrajectories(plot));
	const auto errors = errorsOf(run, slam ? "nodes" : "ekf");
	if (!errors.empty()) write("error.svg", plotErrors({titleOf(run), errorsOf(run, "odom"), errors}));
	const auto judged = judgedNodes(run);
	if (judged.empty()) return;
	write("node-errors.svg", plotNodeErrors(judged));
	write("nees.svg", plotNees(judged));
}
}  // namespace posidonia
