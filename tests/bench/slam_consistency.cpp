// Is the graph as accurate as it says? Statistics over simulated surveys: scripts/bench slam-consistency.
#include <honesty_survey.h>
#include <mrpt/core/format.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/base/ini_file.h>
#include <posidonia/graphslam/CSparseGSO.h>
#include <posidonia/report/svg_plot.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;

namespace
{
struct TMean
{
	double sum{0};
	int count{0};
	void add(double x) { sum += x, count++; }
	double mean() const { return count ? sum / count : 0; }
};

/** Squared errors over their covariance, a degree of freedom: 1 when honest. */
struct TNees
{
	TMean position, attitude, whole;
	void add(const Vector6d& d, const Matrix6d& covariance)
	{
		const Eigen::Vector3d t = d.head<3>(), r = d.tail<3>();
		position.add(t.dot(covariance.topLeftCorner<3, 3>().llt().solve(t)) / 3);
		attitude.add(r.dot(covariance.bottomRightCorner<3, 3>().llt().solve(r)) / 3);
		whole.add(d.dot(covariance.llt().solve(d)) / 6);
	}
};

/** What a graph says of its nodes against the truth: seen from the root, or in the map. */
struct TGraphStatistics
{
	const char* name;
	EEdgeKind last_kind;  // edges of this kind and those before it in EEdgeKind
	bool priors{false}, in_map{false};
	TNees nees{};
	TMean error{}, sigma{};	 // of positions [m]
	std::map<int, TMean> by_node{};
};

struct TStatistics
{
	TGraphStatistics graphs[5] = {
		{"odometry", EEdgeKind::ODOMETRY},
		{"odometry + sequential", EEdgeKind::SEQUENTIAL},
		{"odometry + sequential + loops", EEdgeKind::ROI},
		{"all edges + priors", EEdgeKind::ROI, true},
		{"all edges + priors, in the map", EEdgeKind::ROI, true, true}};
	std::map<EEdgeKind, TNees> edges;
	std::map<EEdgeKind, TMean> shares;
	std::map<int, TMean> correlation;  // of edges at one node, by tenths of common points
	std::map<std::string, int> candidates;
};

Vector6d errorOf(const TSlamEdge& edge, const std::vector<Isometry3d>& truth)
{
	const Isometry3d& T_map_to = truth[static_cast<size_t>(edge.to)];
	return localCoordinates(truth[static_cast<size_t>(edge.from)].inverse() * T_map_to, edge.T_from_to);
}

/** The graph of some edges of the map, with the shares that these have among themselves. */
CPoseGraph graphOf(const CSlamMap& map, const TGraphStatistics& which, const TStereoSlamOptions& options)
{
	TSlamGraph mrpts;
	CSlamMap part;
	part.bind(mrpts);
	part.root_covariance = map.root_covariance;
	for (int i = 0; i < map.nodeCount(); i++)
		part.addNode(map.node(i), map.pose(i));
	for (TSlamEdge edge : map.edges()) {
		if (edge.kind > which.last_kind) continue;
		edge.share = 1;
		part.addEdge(edge);
	}
	if (options.loss.share_information) part.shareInformation();
	return toPoseGraph(part, options.loss, which.priors ? options.priors : TPriorOptions::none());
}

void addNodes(
	TGraphStatistics& s, const CSlamMap& map, const std::vector<Isometry3d>& truth,
	const TStereoSlamOptions& options)
{
	CPoseGraph graph = graphOf(map, s, options);
	CSparseOptimizer optimizer;
	optimizer.optimize(graph);
	const CMarginals marginals = optimizer.marginals(graph);
	const Isometry3d identity = Isometry3d::Identity();
	const Isometry3d T_from_map = s.in_map ? identity : graph.pose(0).inverse(),
					 true_T_from_map = s.in_map ? identity : truth[0].inverse();
	for (int i = 1; i < map.nodeCount(); i++) {
		const Vector6d d =
			localCoordinates(true_T_from_map * truth[static_cast<size_t>(i)], T_from_map * graph.pose(i));
		const Matrix6d covariance = s.in_map ? marginals.covarianceOf(i) : marginals.relativeCovariance(0, i);
		s.nees.add(d, covariance);
		s.error.add(d.head<3>().norm());
		s.sigma.add(std::sqrt(covariance.topLeftCorner<3, 3>().trace()));
		const Eigen::Vector3d t = d.head<3>();
		s.by_node[i].add(t.dot(covariance.topLeftCorner<3, 3>().llt().solve(t)) / 3);
	}
}

/** A stereo edge as one of its nodes sees it: its error there, whitened, and which points it uses. */
struct TEdgeAtNode
{
	Vector6d whitened;
	std::set<int> points;
};

TEdgeAtNode atNode(const TSlamEdge& edge, bool at_to, const std::vector<Isometry3d>& truth)
{
	Vector6d d = errorOf(edge, truth);
	Matrix6d covariance = edge.information.inverse();
	if (!at_to) {  // of T_to_from
		d = -adjoint(edge.T_from_to) * d;
		covariance = inverseCovariance(edge.T_from_to, covariance);
	}
	TEdgeAtNode e;
	e.whitened = Eigen::SelfAdjointEigenSolver<Matrix6d>(0.5 * (covariance + covariance.transpose()))
					 .operatorInverseSqrt() *
				 d;
	for (const auto& [p, q] : edge.points)
		e.points.insert(at_to ? q : p);
	return e;
}

void addCorrelations(TStatistics& s, const CSlamMap& map, const std::vector<Isometry3d>& truth)
{
	std::map<int, std::vector<TEdgeAtNode>> at;
	for (const TSlamEdge& edge : map.edges()) {
		if (edge.kind == EEdgeKind::ODOMETRY) continue;
		at[edge.from].push_back(atNode(edge, false, truth));
		at[edge.to].push_back(atNode(edge, true, truth));
	}
	for (const auto& [node, edges] : at)
		for (size_t a = 0; a < edges.size(); a++)
			for (size_t b = 0; b < a; b++) {
				double common = 0;
				for (const int p : edges[a].points)
					common += static_cast<double>(edges[b].points.count(p));
				const double part =
					common / std::sqrt(double(edges[a].points.size() * edges[b].points.size()));
				s.correlation[static_cast<int>(10 * part)].add(edges[a].whitened.dot(edges[b].whitened) / 6);
			}
}

void addSurvey(TStatistics& s, const THonestyRun& run, const TStereoSlamOptions& options)
{
	const CSlamMap& map = run.slam->map();
	for (const TSlamEdge& edge : map.edges()) {
		s.edges[edge.kind].add(errorOf(edge, run.T_map_body), edge.information.inverse());
		s.shares[edge.kind].add(edge.share);
	}
	for (const auto& row : map.candidates)
		s.candidates[row.status]++;
	for (TGraphStatistics& graph : s.graphs)
		addNodes(graph, map, run.T_map_body, options);
	addCorrelations(s, map, run.T_map_body);
}

/** 95 % band of the mean of `count` chi-squares of 3 degrees of freedom each, a degree of freedom (Wilson and
 * Hilferty). */
std::pair<double, double> band(int count)
{
	const double a = 2.0 / (9 * 3 * count), z = 1.96 * std::sqrt(a);
	return {std::pow(1 - a - z, 3), std::pow(1 - a + z, 3)};
}

void print(const TStatistics& s, int seeds)
{
	std::cout
		<< "single edges                     position  attitude  both (1: honest)  edges   mean share\n";
	for (const auto& [kind, nees] : s.edges)
		std::cout << mrpt::format(
			"  %-30s %8.3f  %8.3f  %8.3f         %6d   %.3f\n", toString(kind), nees.position.mean(),
			nees.attitude.mean(), nees.whole.mean(), nees.whole.count, s.shares.at(kind).mean());
	std::cout << "\nnodes seen from the root (last row: in the map): ANEES a degree of freedom\n"
			  << "                                 position  attitude  both      in band  least..largest  "
				 "error    sigma [mm]\n";
	const auto [low, high] = band(seeds);
	for (const TGraphStatistics& g : s.graphs) {
		int inside = 0;
		double least = 1e9, largest = 0;
		for (const auto& [node, mean] : g.by_node) {
			inside += mean.mean() >= low && mean.mean() <= high;
			least = std::min(least, mean.mean());
			largest = std::max(largest, mean.mean());
		}
		std::cout << mrpt::format(
			"  %-30s %8.3f  %8.3f  %8.3f  %3d of %3d  %.2f..%.2f      %7.3f  %7.3f\n", g.name,
			g.nees.position.mean(), g.nees.attitude.mean(), g.nees.whole.mean(), inside,
			static_cast<int>(g.by_node.size()), least, largest, 1e3 * g.error.mean(), 1e3 * g.sigma.mean());
	}
	std::cout << mrpt::format("  95 %% band of one node over %d seeds: %.2f to %.2f\n\n", seeds, low, high);
	std::cout << "edges that share a node: correlation of their errors by common points (half of it by "
				 "points alone)\n";
	for (const auto& [tenth, mean] : s.correlation)
		std::cout << mrpt::format(
			"  %.1f-%.1f %8.3f  (%d pairs)\n", tenth / 10.0, (tenth + 1) / 10.0, mean.mean(), mean.count);
	std::cout << "\npairs\n";
	for (const auto& [status, count] : s.candidates)
		std::cout << mrpt::format("  %-32s %d\n", status.c_str(), count);
}

void writePlot(const TStatistics& s, int seeds)
{
	const char* colours[] = {"#d55e00", "#e69f00", "#0072b2", "#cc79a7", "#000000"};
	const char* dashes[] = {"7 3.5", "2 2", "", "", "2 2"};
	std::vector<TCurve> curves;
	std::string csv = "node,odometry,odometry_sequential,all,all_priors,all_priors_in_map\n";
	for (int k = 0; k < 5; k++) {
		TCurve curve{s.graphs[k].name, {colours[k], 1.6, dashes[k], 1}, {}};
		for (const auto& [node, mean] : s.graphs[k].by_node)
			curve.points.emplace_back(node, mean.mean());
		curves.push_back(curve);
	}
	const auto [low, high] = band(seeds);
	const double last = curves[0].points.back().x();
	for (const double y : {low, high})
		curves.push_back({y == low ? "95 % band" : "", {"#009e73", 1, "4 4", 1}, {{1, y}, {last, y}}});
	for (const auto& [node, mean] : s.graphs[0].by_node) {
		csv += std::to_string(node);
		for (const TGraphStatistics& g : s.graphs)
			csv += mrpt::format(",%.4f", g.by_node.at(node).mean());
		csv += "\n";
	}
	const std::string folder = "runs/slam-consistency";
	std::filesystem::create_directories(folder);
	writeFileWhole(folder + "/anees.csv", [&](std::ostream& out) { out << csv; });
	TPlotSize size;
	size.vertical_from_zero = true;
	writeFileWhole(folder + "/anees.svg", [&](std::ostream& out) {
		out << svgPlot({"Position", "node", "ANEES / 3"}, curves, size);
	});
	std::cout << "\n" << folder << "/anees.csv, anees.svg\n";
}

TStereoSlamOptions optionsOf(int argc, char** argv)
{
	TStereoSlamOptions options;
	CIniFile ini = CIniFile::fromText("");
	for (int k = 3; k < argc; k++)
		ini.set(argv[k]);
	options.forEachSection([&](const char* section, auto& part) { ini.loadOnto(part, section); });
	ini.refuseUnknown();
	return options;
}
}  // namespace

/** slam_consistency [seeds = 20] [first seed = 21] [Section.key=value ...] */
int main(int argc, char** argv)
{
	try {
		const int seeds = argc > 1 ? std::atoi(argv[1]) : 20, first = argc > 2 ? std::atoi(argv[2]) : 21;
		const TStereoSlamOptions options = optionsOf(argc, argv);
		TStatistics statistics;
		for (int seed = first; seed < first + seeds; seed++) {
			const std::string photo = POSIDONIA_SOURCE_DIR "/ini/textures/noaa_reef.jpg";
			const auto survey = honestySurvey(static_cast<unsigned>(seed), photo);
			addSurvey(statistics, runHonestySurvey(survey, options), options);
			std::cerr << "seed " << seed << "\n";
		}
		std::cout << "seeds " << first << " to " << first + seeds - 1 << "\n\n";
		print(statistics, seeds);
		writePlot(statistics, seeds);
	}
	catch (const std::exception& error) {
		std::cerr << error.what() << "\n";
		return 1;
	}
	return 0;
}
