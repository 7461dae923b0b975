// CPU time of the pose-graph back-end beside its peers, in one process on one thread: scripts/bench
// posegraph.
#include <posidonia/apps/graph_replay.h>
#include <posidonia/apps/graph_solvers.h>
#include <posidonia/apps/mrpt_levmarq.h>
#include <posidonia/apps/process_meter.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/number_text.h>
#include <posidonia/eval/text_table.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/g2o_file.h>
#include <posidonia/posegraph/graduated_nonconvexity.h>
#include <posidonia/posegraph/incremental_optimizer.h>
#include <posidonia/posegraph/multifrontal_cholesky.h>
#include <posidonia/posegraph/sparse_optimizer.h>
#include <synthetic_graphs.h>

#include <generated_sphere.h>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "posegraph_peers.h"

using namespace posidonia;
using namespace posidonia::bench;
using namespace posidonia::testing;
using nlohmann::json;

namespace
{
struct TSettings
{
	bool full{false};
	int repetitions{5};
	std::string json_file;
	std::set<int> tables{1, 2, 3, 4, 5};
	int first_seed{11}, seeds{10};	///< Of table 4
};

/** Beyond so many nodes MRPT's levmarq takes minutes: it gets few iterations, which tell its speed. */
constexpr size_t kLargeForMrpt = 5000;

/** All rows of all tables, for --json. */
json& rows()
{
	static json all = json::array();
	return all;
}

/** q in [0, 1] of v, nearest rank. */
double quantile(std::vector<double> v, double q)
{
	std::sort(v.begin(), v.end());
	return v.at(std::min(v.size() - 1, size_t(q * double(v.size()))));
}
double median(const std::vector<double>& v)
{
	return quantile(v, 0.5);
}

double cpuOf(const std::function<void()>& work)
{
	const double start = processCpuSeconds();
	work();
	return processCpuSeconds() - start;
}

struct TNamedGraph
{
	std::string name;
	CPoseGraph graph;
	double known_optimum{0};  ///< chi2; 0: the lowest that a solver of this run reaches
};

std::optional<TNamedGraph> publicGraph(const std::string& name, double optimum)
{
	const char* given = std::getenv("POSIDONIA_DATA");
	const std::string folder = given ? given : POSIDONIA_SOURCE_DIR "/../shared/data";
	const std::string path = folder + "/pose-graphs/" + name + ".g2o";
	if (std::filesystem::exists(path)) return TNamedGraph{name, readG2o(path).graph, optimum};
	std::cout << path << " is absent: its rows are left out (set POSIDONIA_DATA)\n";
	return std::nullopt;
}

TNamedGraph survey(int nodes)
{
	TLawnMower options;
	options.nodes = nodes;
	return {"lawn-mower " + std::to_string(nodes), lawnMower(options).graph, 0};
}

// ---------------------------------------------------------------------------------------------- table 1

struct TSolver
{
	std::string name;
	std::function<TPeerResult(CPoseGraph&)> run;
	int repetitions;
};

std::vector<TSolver> batchSolvers(int repetitions)
{
	const auto ceres = [](TCeresOptions options) {
		return [options](CPoseGraph& graph) { return optimizeWithCeres(graph, options); };
	};
	TCeresOptions automatic, standard;
	automatic.analytic = false;
	standard.initial_radius = 1e4;
	return {
		{"own batch",
		 [](CPoseGraph& graph) {
			 TOptimizerOptions options;
			 options.min_relative_decrease = TCeresOptions().function_tolerance;
			 const auto result = CSparseOptimizer(options).optimize(graph);
			 return TPeerResult{result.iterations, result.converged()};
		 },
		 repetitions},
		{"Ceres, analytic, radius 1e16", ceres({}), repetitions},
		{"Ceres, automatic, radius 1e16", ceres(automatic), repetitions},
		{"Ceres, analytic, default radius", ceres(standard), std::min(3, repetitions)},
		{"MRPT levmarq, capped",
		 [](CPoseGraph& graph) {
			 const auto result = optimizeWithLevMarq(graph, graph.nodeCount() > kLargeForMrpt ? 3 : 30);
			 return TPeerResult{result.iterations, result.stopped};
		 },
		 1}};
}

struct TRuns
{
	std::vector<double> cpu;
	TPeerResult result;
	double chi2{0};
};

/** Every solver once, then every solver again ...: what disturbs the machine disturbs all alike. */
std::vector<TRuns> interleaved(const CPoseGraph& graph, const std::vector<TSolver>& solvers, int repetitions)
{
	std::vector<TRuns> runs(solvers.size());
	for (int repetition = 0; repetition < repetitions; repetition++)
		for (size_t s = 0; s < solvers.size(); s++) {
			if (repetition >= solvers[s].repetitions) continue;
			CPoseGraph work = graph;
			runs[s].cpu.push_back(cpuOf([&] { runs[s].result = solvers[s].run(work); }));
			runs[s].chi2 = chi2(work);
		}
	return runs;
}

void batchTable(const TNamedGraph& named, int repetitions)
{
	const auto solvers = batchSolvers(repetitions);
	const auto runs = interleaved(named.graph, solvers, repetitions);
	double best = named.known_optimum;
	if (best <= 0)
		best = std::min_element(runs.begin(), runs.end(), [](auto& a, auto& b) {
				   return a.chi2 < b.chi2;
			   })->chi2;
	CTextTable table({named.name, "CPU [s]", "fastest", "own / this", "iterations", "chi2", "above best"});
	const double own = median(runs[0].cpu);
	for (size_t s = 0; s < solvers.size(); s++) {
		const TRuns& r = runs[s];
		const double cpu = median(r.cpu), above = r.chi2 / best - 1;
		table.add(
			{solvers[s].name, fixedText(cpu, 4), fixedText(quantile(r.cpu, 0), 4), fixedText(own / cpu, 3),
			 std::to_string(r.result.iterations) + (r.result.converged ? "" : " (not converged)"),
			 significantText(r.chi2, 9), significantText(above, 2)});
		rows().push_back(
			{{"table", 1},
			 {"graph", named.name},
			 {"solver", solvers[s].name},
			 {"cpu_s", cpu},
			 {"own_over_this", own / cpu},
			 {"iterations", r.result.iterations},
			 {"converged", r.result.converged},
			 {"chi2", r.chi2},
			 {"above_best", above}});
	}
	std::cout << table.text() << "\n" << std::flush;
}

// -------------------------------------------------------------------------------------- tables 2 and 3

/** Takes the graph as it is after a node was added; `closed`: with an edge to an older node. */
using TStepper = std::function<void(CPoseGraph& graph, bool closed)>;

/** The solvers that follow a growing graph. */
struct TFollower
{
	std::string name;
	std::function<TStepper()> make;
	int largest_survey;	 ///< Nodes of the longest lawn-mower that it finishes in reasonable time
};

/** One Gauss-Newton step of the whole graph at each closing, nothing else: no second linearisation and no
 * cost of the result. */
TStepper batchStepper()
{
	struct TState
	{
		CMultifrontalCholesky cholesky;
		CNormalEquations system;
	};
	return [state = std::make_shared<TState>()](CPoseGraph& graph, bool closed) {
		if (!closed) return;
		state->system.followStructure(graph, state->cholesky);
		state->system.linearize(graph);
		if (!state->cholesky.factorize(state->system.H(), state->system.b()))
			throw CError("batch step", "H is not positive definite", "");
		const Eigen::VectorXd& d = state->cholesky.solve();
		std::vector<Eigen::Isometry3d> poses = graph.poses();
		for (int column = 0; column < state->system.freeNodeCount(); column++) {
			auto& T = poses[size_t(state->system.nodeOf(column))];
			T = orthonormalized(retract(T, d.segment<6>(6 * column)));
		}
		graph.setPoses(poses);
	};
}

TStepper incrementalStepper()
{
	return [optimizer = std::make_shared<CIncrementalOptimizer>()](CPoseGraph& graph, bool) {
		optimizer->update(graph);
	};
}

const std::vector<TFollower>& followers()
{
	static const std::vector<TFollower> all{
		{"batch, one Gauss-Newton step a closing", batchStepper, 1000},
		{"incremental", incrementalStepper, 1000000}};
	return all;
}

struct TReplay
{
	CPoseGraph graph;
	std::vector<double> node_cpu;	  ///< Of each added node [s]
	std::vector<double> closing_cpu;  ///< Of those that closed a loop
	double total() const { return std::accumulate(node_cpu.begin(), node_cpu.end(), 0.0); }
};

TReplay replay(const CPoseGraph& whole, const TStepper& step)
{
	TReplay out;
	for (CGraphReplay arrival(whole); !arrival.done();) {
		bool closed = false;
		out.node_cpu.push_back(cpuOf([&] {
			closed = arrival.addNext(out.graph);
			step(out.graph, closed);
		}));
		if (closed) out.closing_cpu.push_back(out.node_cpu.back());
	}
	return out;
}

CPoseGraph firstNodes(const CPoseGraph& whole, int count)
{
	CPoseGraph part;
	for (CGraphReplay arrival(whole); !arrival.done() && int(part.nodeCount()) < count;)
		arrival.addNext(part);
	return part;
}

void incrementalTable(const TNamedGraph& named)
{
	CPoseGraph optimum = named.graph;
	CSparseOptimizer().optimize(optimum);
	const double best = chi2(optimum);
	CTextTable table(
		{named.name + ", node by node", "total CPU [s]", "this / batch", "median [ms]", "p95 [ms]",
		 "worst [ms]", "worst / batch median", "chi2", "above optimum"});
	double batch_total = 0, batch_median = 0;
	for (const TFollower& follower : followers()) {
		const TReplay r = replay(named.graph, follower.make());
		if (batch_total <= 0) batch_total = r.total(), batch_median = median(r.closing_cpu);
		const double worst = quantile(r.node_cpu, 1), value = chi2(r.graph);
		table.add(
			{follower.name, fixedText(r.total(), 2), fixedText(r.total() / batch_total, 3),
			 fixedText(1e3 * median(r.closing_cpu), 3), fixedText(1e3 * quantile(r.closing_cpu, 0.95), 3),
			 fixedText(1e3 * worst, 2), fixedText(worst / batch_median, 2), significantText(value, 8),
			 significantText(value / best - 1, 2)});
		rows().push_back(
			{{"table", 2},
			 {"graph", named.name},
			 {"solver", follower.name},
			 {"cpu_s", r.total()},
			 {"over_batch", r.total() / batch_total},
			 {"median_s", median(r.closing_cpu)},
			 {"worst_s", worst},
			 {"worst_over_batch_median", worst / batch_median},
			 {"chi2", value},
			 {"above_optimum", value / best - 1}});
	}
	std::cout << table.text() << "\n" << std::flush;
}

/** `wide`: tracks of 316 nodes and 10 edges a node instead of 100 and 5. */
TLawnMower surveyOptions(int nodes, bool wide)
{
	TLawnMower options;
	options.nodes = nodes;
	if (wide) options.track = 316, options.sequential = 4, options.across = 6;
	return options;
}

/** The survey's edges, in order of arrival: each goes from an older node to the newest. */
std::deque<TPoseEdge> surveyEdges(int nodes, bool wide)
{
	const CPoseGraph whole = lawnMower(surveyOptions(nodes, wide)).graph;
	return {whole.edges().begin(), whole.edges().end()};
}

/** As replay(), but what has arrived is forgotten: of a long survey a second copy would count as memory. */
TReplay replaySurvey(std::deque<TPoseEdge> edges, const TStepper& step)
{
	TReplay out;
	out.graph.addNode(Eigen::Isometry3d::Identity(), true);
	while (!edges.empty()) {
		const int node = edges.front().to;
		bool closed = false;
		out.node_cpu.push_back(cpuOf([&] {
			out.graph.addNode(orthonormalized(out.graph.pose(node - 1) * edges.front().T_from_to));
			for (; !edges.empty() && edges.front().to == node; edges.pop_front()) {
				closed |= edges.front().from < node - 1;
				out.graph.addEdge(edges.front());
			}
			step(out.graph, closed);
		}));
	}
	return out;
}

/** In its own process, so that the peak of memory is its own: one JSON object on stdout. */
void surveyChild(int follower, int nodes, bool wide)
{
	auto edges = surveyEdges(nodes, wide);
	const size_t edge_count = edges.size();
	const double before = peakMemoryMb();
	const TReplay r = replaySurvey(std::move(edges), followers().at(size_t(follower)).make());
	const size_t settled = r.node_cpu.size() / 2;  // the later half: the first nodes cost next to nothing
	const std::vector<double> later(r.node_cpu.begin() + std::ptrdiff_t(settled), r.node_cpu.end());
	std::cout << json{{"table", 3}, {"solver", followers().at(size_t(follower)).name}, {"nodes", nodes},
					  {"track", surveyOptions(nodes, wide).track}, {"edges", edge_count},
					  {"median_s", median(r.node_cpu)}, {"p95_s", quantile(r.node_cpu, 0.95)},
					  {"worst_s", quantile(r.node_cpu, 1)}, {"later_half_median_s", median(later)},
					  {"total_s", r.total()}, {"chi2", chi2(r.graph)}, {"peak_memory_mb", peakMemoryMb()},
					  {"graph_memory_mb", before}}
			  << "\n";
}

json fromChild(int follower, int nodes, bool wide)
{
	const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
	const std::string command = "'" + program + "' --survey-child " + std::to_string(follower) + " " +
								std::to_string(nodes) + (wide ? " wide" : " narrow");
	FILE* pipe = popen(command.c_str(), "r");
	if (!pipe) throw CError(command, "can't be started", "");
	std::string text;
	for (char buffer[4096]; const size_t n = fread(buffer, 1, sizeof buffer, pipe);)
		text.append(buffer, n);
	if (pclose(pipe) != 0) throw CError(command, "failed", "see its message above");
	return json::parse(text);
}

void surveyTable(const TSettings& settings, bool wide)
{
	CTextTable table(
		{wide ? "lawn-mower, tracks of 316, 10 edges a node" : "lawn-mower, tracks of 100, 5 edges a node",
		 "nodes", "edges", "median [ms]", "p95 [ms]", "worst [ms]", "median / 1e3's", "p95 / 1e3's",
		 "total [s]", "peak [MB]"});
	for (int f = 0; f < int(followers().size()); f++) {
		json first;
		for (const int nodes : {1000, 10000, 100000}) {
			if (nodes > followers()[size_t(f)].largest_survey || (nodes > 10000 && !settings.full)) continue;
			const json r = fromChild(f, nodes, wide);
			if (first.is_null()) first = r;
			const auto value = [&](const char* key) { return r.at(key).get<double>(); };
			const auto ratio = [&](const char* key) { return value(key) / first.at(key).get<double>(); };
			table.add(
				{followers()[size_t(f)].name, std::to_string(nodes), std::to_string(r.at("edges").get<int>()),
				 fixedText(1e3 * value("median_s"), 3), fixedText(1e3 * value("p95_s"), 3),
				 fixedText(1e3 * value("worst_s"), 2), fixedText(ratio("median_s"), 2),
				 fixedText(ratio("p95_s"), 2), fixedText(value("total_s"), 2),
				 fixedText(value("peak_memory_mb"), 0)});
			rows().push_back(r);
		}
	}
	std::cout << table.text() << "\n" << std::flush;
}

// ---------------------------------------------------------------------------------------------- table 4

/** What graduated non-convexity makes of one generated sphere. */
struct TGncScore
{
	double odometry, oracle, gnc;  ///< Mean position errors [m]; oracle: the optimum from true edges alone
	double found, refused;		   ///< Parts of the wrong loops and of the true ones that were rejected [-]
	int rounds;
	double cpu;
	double ratio() const { return gnc / oracle; }
};

TGncScore gncScore(unsigned seed)
{
	constexpr int kRings = 50;
	constexpr double kNoise = 1, kWrongLoops = 0.3;
	TGeneratedSphere made = testing::generatedSphere(seed, kRings, kNoise, kWrongLoops);
	CPoseGraph oracle = trueEdgesOnly(made);
	CSparseOptimizer().optimize(oracle);
	TGncScore score{};
	score.odometry = meanPositionError(made.graph, made.truth);
	score.oracle = meanPositionError(oracle, made.truth);
	TGncResult result;
	score.cpu = cpuOf([&] { result = CGraduatedNonconvexity().optimize(made.graph); });
	score.gnc = meanPositionError(made.graph, made.truth);
	score.rounds = result.rounds;
	double wrong = 0, right = 0;
	for (size_t k = 0; k < made.wrong.size(); k++) {
		if (!isLoop(made.graph.edge(int(k)))) continue;
		const double rejected = result.edge_weights[k] == 0 ? 1 : 0;
		(made.wrong[k] ? wrong : right)++;
		(made.wrong[k] ? score.found : score.refused) += rejected;
	}
	score.found /= wrong;
	score.refused /= right;
	return score;
}

void addGncRow(CTextTable& table, const std::string& name, const TGncScore& s)
{
	table.add(
		{name, fixedText(s.odometry, 3), fixedText(s.oracle, 3), fixedText(s.gnc, 3), fixedText(s.ratio(), 3),
		 fixedText(100 * s.found, 2), fixedText(100 * s.refused, 2), std::to_string(s.rounds),
		 fixedText(s.cpu, 2)});
}

/** Generated spheres of 2500 nodes with 30 % of the loops wrong. */
void gncTable(const TSettings& settings)
{
	CTextTable table(
		{"seed", "odometry [m]", "true edges [m]", "GNC [m]", "ratio", "wrong ones found [%]",
		 "true ones refused [%]", "rounds", "CPU [s]"});
	TGncScore worst{0, 1, 0, 1, 0, 0, 0};
	for (int seed = settings.first_seed; seed < settings.first_seed + settings.seeds; seed++) {
		const TGncScore s = gncScore(unsigned(seed));
		addGncRow(table, std::to_string(seed), s);
		rows().push_back(
			{{"table", 4},
			 {"seed", seed},
			 {"odometry_m", s.odometry},
			 {"true_edges_m", s.oracle},
			 {"gnc_m", s.gnc},
			 {"ratio", s.ratio()},
			 {"found", s.found},
			 {"refused", s.refused},
			 {"rounds", s.rounds},
			 {"cpu_s", s.cpu}});
		if (s.ratio() > worst.ratio()) worst.oracle = s.oracle, worst.gnc = s.gnc;
		worst.odometry = std::max(worst.odometry, s.odometry);
		worst.found = std::min(worst.found, s.found);
		worst.refused = std::max(worst.refused, s.refused);
		worst.rounds = std::max(worst.rounds, s.rounds);
		worst.cpu = std::max(worst.cpu, s.cpu);
	}
	addGncRow(table, "worst", worst);
	std::cout << table.text() << "\n" << std::flush;
}

// ---------------------------------------------------------------------------------------------- table 5

/** All 6x6 marginals of the nodes, as a multiple of one numeric factorisation. */
void marginalsTable(int nodes)
{
	CPoseGraph graph = survey(nodes).graph;
	CSparseOptimizer optimizer;
	optimizer.optimize(graph);
	CMultifrontalCholesky cholesky;
	CNormalEquations system;
	system.followStructure(graph, cholesky);
	system.linearize(graph);
	std::vector<double> factor, all;
	for (int repetition = 0; repetition < 3; repetition++) {
		factor.push_back(cpuOf([&] { cholesky.factorize(system.H(), system.b()); }));
		const CMarginals marginals = optimizer.marginals(graph);
		double trace = 0;
		all.push_back(cpuOf([&] {
			for (const Matrix6d& covariance : marginals.allCovariances())
				trace += covariance.trace();
		}));
		if (!(trace > 0)) throw CError("marginals", "no covariance at all", "");
	}
	const double ratio = median(all) / median(factor);
	CTextTable table({"marginals of all nodes", "factorisation [s]", "marginals [s]", "ratio"});
	table.add(
		{std::to_string(nodes) + " nodes", fixedText(median(factor), 4), fixedText(median(all), 3),
		 fixedText(ratio, 2)});
	rows().push_back(
		{{"table", 5},
		 {"nodes", nodes},
		 {"factorize_s", median(factor)},
		 {"marginals_s", median(all)},
		 {"ratio", ratio}});
	std::cout << table.text() << "\n" << std::flush;
}

std::optional<TNamedGraph> sphere2500()
{
	return publicGraph("sphere2500", 727.1497);
}

TNamedGraph drawnSphere()
{
	return {"generated sphere", sphere({}).graph, 0};
}

void batchTables(const TSettings& settings)
{
	for (const auto& named : {sphere2500(), publicGraph("parking-garage", 1.238691)})
		if (named) batchTable(*named, settings.repetitions);
	batchTable(drawnSphere(), settings.repetitions);
	batchTable(survey(settings.full ? 10000 : 1000), std::min(3, settings.repetitions));
}

void incrementalTables(const TSettings& settings)
{
	TNamedGraph named = sphere2500().value_or(drawnSphere());
	if (!settings.full) named = {named.name + ", first 1000 nodes", firstNodes(named.graph, 1000), 0};
	incrementalTable(named);
}

void runAll(const TSettings& settings)
{
	std::cout << "BLAS of Ceres: " << blasText() << "; own kernels: " << simdName()
			  << "; one thread. CPU seconds of the process, set-up included; medians of "
			  << settings.repetitions << " interleaved runs (MRPT: 1). chi2 by one evaluator.\n\n";
	const auto wanted = [&](int table, const char* title) {
		const bool yes = settings.tables.count(table) > 0;
		if (yes) std::cout << "== " << table << ". " << title << "\n";
		return yes;
	};
	if (wanted(1, "batch, from the file's poses (generated graphs: from dead reckoning)"))
		batchTables(settings);
	if (wanted(2, "node by node")) incrementalTables(settings);
	if (wanted(3, "surveys that grow"))
		for (const bool wide : {false, true})
			surveyTable(settings, wide);
	if (wanted(4, "graduated non-convexity, 30 % of the loops wrong")) gncTable(settings);
	if (wanted(5, "marginals")) marginalsTable(settings.full ? 10000 : 1000);
	if (!settings.json_file.empty())
		writeFileWhole(settings.json_file, [](std::ostream& out) { out << rows().dump(1, '\t') << "\n"; });
}
}  // namespace

/** bench_posegraph [quick|full] [--table N] [--json FILE] [--repetitions N] [--seeds N] [--first N] */
int main(int argc, char** argv)
{
	try {
		useOneThread();
		const std::vector<std::string> args(argv + 1, argv + argc);
		if (args.size() == 4 && args[0] == "--survey-child") {
			surveyChild(std::stoi(args[1]), std::stoi(args[2]), args[3] == "wide");
			return 0;
		}
		TSettings settings;
		for (size_t i = 0; i < args.size(); i++) {
			if (args[i] == "quick" || args[i] == "full")
				settings.full = args[i] == "full";
			else if (args[i] == "--json" && i + 1 < args.size())
				settings.json_file = args[++i];
			else if (args[i] == "--repetitions" && i + 1 < args.size())
				settings.repetitions = std::max(1, std::stoi(args[++i]));
			else if (args[i] == "--first" && i + 1 < args.size())
				settings.first_seed = std::stoi(args[++i]);
			else if (args[i] == "--seeds" && i + 1 < args.size())
				settings.seeds = std::max(1, std::stoi(args[++i]));
			else if (args[i] == "--table" && i + 1 < args.size())
				settings.tables = {std::stoi(args[++i])};
			else
				throw CUsageError(
					args[i], "is unknown",
					"give quick or full, --table N, --json FILE, --repetitions N, --seeds N, --first N");
		}
		runAll(settings);
		return 0;
	}
	catch (const std::exception& problem) {
		std::cerr << "bench_posegraph: error: " << problem.what() << "\n";
		return 1;
	}
}
