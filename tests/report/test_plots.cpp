#include "svg_testing.h"

#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/report/error_plot.h>
#include <posidonia/report/trajectory_plot.h>

#include <cstdlib>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector3d;

namespace
{
/** The paper's Table 1 route by steps of 0.3 m: 600 nodes. */
std::vector<Vector3d> paperRoute()
{
	const std::vector<Eigen::Vector2d> corners{{0, 0},	{0, 12},  {5, 12},	 {5, 6},	{-5, 6},  {-5, 0},
											   {5, 0},	{5, -6},  {-5, -6},	 {-5, -12}, {5, -12}, {5, 12},
											   {0, 12}, {0, -12}, {-5, -12}, {-5, 12},	{0, 12},  {0, 0}};
	std::vector<Vector3d> route;
	for (size_t c = 1; c < corners.size(); c++) {
		const int steps = static_cast<int>((corners[c] - corners[c - 1]).norm() / 0.3);
		for (int i = 0; i < steps; i++) {
			const Eigen::Vector2d p = corners[c - 1] + (corners[c] - corners[c - 1]) * i / steps;
			route.emplace_back(p.x(), p.y(), 3.5);
		}
	}
	return route;
}

/** Positions moved by `drift` metres a metre and a wobble. */
TTrajectory drifted(const std::vector<Vector3d>& route, double drift, double wobble)
{
	TTrajectory trajectory;
	for (size_t i = 0; i < route.size(); i++) {
		TStampedPose pose;
		pose.stamp = static_cast<double>(i);
		const double s = 0.3 * pose.stamp;
		pose.T.translation() = route[i] + Vector3d(drift * s, drift * s, drift * s / 3) +
							   wobble * Vector3d(std::sin(0.4 * s), std::cos(0.31 * s), 0);
		trajectory.push_back(pose);
	}
	return trajectory;
}

std::vector<TLoopRow> loopsBetweenNear(const TTrajectory& nodes)
{
	std::vector<TLoopRow> rows;
	for (size_t j = 0; j < nodes.size(); j += 3)
		for (size_t i = 0; i + 60 < j; i += 3)
			if ((nodes[i].T.translation() - nodes[j].T.translation()).norm() < 0.8) {
				rows.emplace_back();
				rows.back().from = i;
				rows.back().to = j;
				rows.back().kind = "roi";
				rows.back().status = "accepted";
			}
	return rows;
}

TTrajectoryPlot samplePlot()
{
	TTrajectoryPlot plot;
	plot.title = "Experiment 2: trajectories (sample)";
	plot.truth = drifted(paperRoute(), 0, 0);
	plot.odometry = drifted(paperRoute(), 0.012, 0.05);
	plot.slam = drifted(paperRoute(), 0, 0.1);
	plot.loops = loopSegments(loopsBetweenNear(plot.slam), plot.odometry);
	return plot;
}

std::vector<TPoseError> errorsOf(const TTrajectoryPlot& plot, const TTrajectory& estimate)
{
	TAssociation poses;
	for (size_t i = 0; i < plot.truth.size(); i++)
		poses.push_back({plot.truth[i].stamp, i, plot.truth[i].T, estimate[i].T});
	return absoluteError(poses, EAlignment::None).poses;
}

/** POSIDONIA_SAMPLE_DIR=<folder> keeps the pictures, to be looked at. */
void keepSample(const std::string& name, const std::string& svg)
{
	if (const char* folder = std::getenv("POSIDONIA_SAMPLE_DIR"))
		writeFileWhole(std::string(folder) + "/" + name, [&](std::ostream& out) { out << svg; });
}
}  // namespace

TEST(TrajectoryPlot, IsTheFigureWithLegendLabelsAndEqualScale)
{
	const TTrajectoryPlot plot = samplePlot();
	const std::string svg = plotTrajectories(plot);
	keepSample("sample.svg", svg);
	EXPECT_EQ(wellFormednessProblem(svg), "");
	EXPECT_EQ(svg.find("nan"), std::string::npos);
	EXPECT_LT(svg.size(), 60000u);
	const std::string loops = ">loop closings (" + std::to_string(plot.loops.size()) + ")<";
	for (const std::string words :
		 {">truth<", ">odometry<", ">SLAM<", ">x north [m]<", ">y east [m]<", loops.c_str()})
		EXPECT_NE(svg.find(words), std::string::npos) << words;
	const TAxisReader x(svg, 'x'), y(svg, 'y');
	EXPECT_NEAR(x.scale(), -y.scale(), 0.01 * x.scale());
	const auto truth = curvePixels(svg, 1);	 // 0: loops
	ASSERT_EQ(truth.size(), plot.truth.size());
	for (size_t i = 0; i < truth.size(); i += 50) {
		EXPECT_NEAR(truth[i].x(), x.pixel(plot.truth[i].T.translation().x()), 0.3) << "i=" << i;
		EXPECT_NEAR(truth[i].y(), y.pixel(plot.truth[i].T.translation().y()), 0.3) << "i=" << i;
	}
}

TEST(TrajectoryPlot, LeavesOutWhatIsEmpty)
{
	TTrajectoryPlot plot;
	plot.slam = drifted(paperRoute(), 0, 0);
	const std::string svg = plotTrajectories(plot);
	EXPECT_NE(svg.find(">SLAM<"), std::string::npos);
	EXPECT_EQ(svg.find(">odometry<"), std::string::npos);
	EXPECT_EQ(svg.find("loop closings"), std::string::npos);
	EXPECT_EQ(svg.find("turned down"), std::string::npos);
	EXPECT_THROW(plotTrajectories({}), CError);
}

TEST(TrajectoryPlot, LoopSegmentsAreTheAcceptedLoops)
{
	const TTrajectory nodes = drifted(paperRoute(), 0, 0);
	std::vector<TLoopRow> rows(4);
	rows[0].to = 7;
	rows[0].status = rows[2].status = "accepted";
	rows[1].status = "too few matches";
	rows[2].kind = "sequential";
	const auto segments = loopSegments({rows[0], rows[1], rows[2]}, nodes);
	ASSERT_EQ(segments.size(), 1u);
	EXPECT_EQ(segments[0].second, nodes[7].T.translation());
	EXPECT_TRUE(rejectedLoopSegments(rows, nodes).empty());
	rows[0].weight = 0.1;
	EXPECT_TRUE(loopSegments({rows[0]}, nodes).empty());
	ASSERT_EQ(rejectedLoopSegments(rows, nodes).size(), 1u);
	EXPECT_EQ(rejectedLoopSegments(rows, nodes)[0].second, nodes[7].T.translation());
	rows[0].to = nodes.size();
	EXPECT_THROW(rejectedLoopSegments({rows[0]}, nodes), CError);
}

TEST(ErrorPlot, CurvesAreTheErrorsAlongTheRoute)
{
	const TTrajectoryPlot run = samplePlot();
	const TErrorPlot plot{
		"Experiment 2: 3D error along the route (sample)", errorsOf(run, run.odometry),
		errorsOf(run, run.slam)};
	const std::string svg = plotErrors(plot);
	keepSample("sample_error.svg", svg);
	EXPECT_EQ(wellFormednessProblem(svg), "");
	EXPECT_LT(svg.size(), 60000u);
	for (const char* words : {">odometry<", ">SLAM<", ">distance travelled [m]<", ">3D error [m]<"})
		EXPECT_NE(svg.find(words), std::string::npos) << words;
	const TAxisReader x(svg, 'x'), y(svg, 'y');
	EXPECT_EQ(y.value0, 0) << "errors start at zero";
	const auto odometry = curvePixels(svg, 0);
	ASSERT_EQ(odometry.size(), plot.odometry.size());
	for (size_t i = 0; i < odometry.size(); i += 50) {
		EXPECT_NEAR(odometry[i].x(), x.pixel(plot.odometry[i].distance), 0.3) << "i=" << i;
		EXPECT_NEAR(odometry[i].y(), y.pixel(plot.odometry[i].translation), 0.3) << "i=" << i;
	}
	EXPECT_THROW(plotErrors({}), CError);
}
