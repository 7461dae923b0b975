#include <posidonia/apps/CGraphOptimizeApp.h>
#include <posidonia/apps/experiment.h>
#include <posidonia/eval/number_text.h>
#include <posidonia/eval/text_table.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/g2o_file.h>
#include <posidonia/posegraph/multifrontal_cholesky.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace posidonia
{
namespace
{
constexpr double kOutlierWeight = 0.5;

/** A flag that takes one of some names. */
class CChoiceFlag
{
   public:
	CChoiceFlag(
		const std::string& flag, const std::string& text, std::vector<std::string> names, TCLAP::CmdLine& cmd)
		: m_names(std::move(names)),
		  m_one_of(m_names),
		  m_arg(
			  "", flag, text + " (default: " + m_names.front() + ")", false, m_names.front(), &m_one_of, cmd)
	{
	}
	const std::string& value() { return m_arg.getValue(); }

   private:
	std::vector<std::string> m_names;
	TCLAP::ValuesConstraint<std::string> m_one_of;
	TCLAP::ValueArg<std::string> m_arg;
};

/** [GraphOptimizer] over the batch solver's own defaults; an ini's other sections are for other apps. */
TOptimizerOptions optimizerOptions(CIniFile& ini)
{
	TSensorSuite sensors = TSensorSuite::sparus2();
	TExperiment::load(ini, sensors);
	return ini.load<TOptimizerOptions>("GraphOptimizer");
}

void refuseBadOutput(const CGraphOptimizeApp::TParams& params)
{
	const std::string& out = params.output;
	if (out.empty()) return;
	if (fs::path(out).extension() == ".graph")
		throw CUsageError("-o " + out, "would hold g2o, the only format written", "name it .g2o");
	if (fs::exists(out) && fs::exists(params.input) && fs::equivalent(out, params.input))
		throw CUsageError("-o " + out, "is the input itself, which would be lost", "give another name");
}

void refuseFlagsWithoutEffect(const CGraphOptimizeApp::TParams& params, bool scale_given, bool threads_given)
{
	const std::string& kernel = params.robust.kernel;
	const bool robust = kernel != "none";
	if (scale_given && !takesScale(kernel))
		throw CUsageError(
			"--robust-scale", "has no effect " + (robust ? "with --robust " + kernel : "without --robust"),
			"leave it out");
	if (!(params.robust.scale > 0)) throw CUsageError("--robust-scale", "must be > 0", "give another number");
	if (params.solver == "incremental" && params.start != "file")
		throw CUsageError("--init", "has no effect with --solver incremental", "leave it out");
	if (robust && params.solver == "levmarq")
		throw CUsageError("--robust", "MRPT's levmarq has no robust losses", "use --solver batch");
	if (kernel == "gnc" && params.solver == "incremental")
		throw CUsageError("--robust gnc", "needs the whole graph", "use --solver batch");
	if (threads_given && params.solver == "levmarq")
		throw CUsageError("--threads", "MRPT's levmarq has one only", "leave it out");
}

int checkedThreads(int threads)
{
	if (threads < 1 || threads > 64)
		throw CUsageError("--threads " + std::to_string(threads), "is not 1 to 64", "give another number");
	return threads;
}

size_t freeNodesOf(const CPoseGraph& graph)
{
	size_t free = 0;
	for (size_t n = 0; n < graph.nodeCount(); n++)
		free += graph.isFixed(static_cast<int>(n)) ? 0 : 1;
	return free;
}

double reducedChi2(const CPoseGraph& graph, double chi2, size_t edges)
{
	const double free = static_cast<double>(freeNodesOf(graph));
	const double redundancy = 6 * (static_cast<double>(edges) - free);
	return redundancy > 0 ? chi2 / redundancy : 0;
}

/** What goes wrong in a solver names nodes by their place; the file's ids may be others. */
template <class F>
void namingTheFile(const TGraphFile& file, const std::string& path, const F& work)
{
	try {
		work();
	}
	catch (const CError& error) {
		const bool counted = !file.file_ids.empty() && file.file_ids.front() == 0 &&
							 file.file_ids.back() == static_cast<long long>(file.file_ids.size()) - 1;
		throw CError(
			path, error.what(), counted ? "" : "nodes are counted from 0 here, in the order of their ids");
	}
}
}  // namespace

bool CGraphOptimizeApp::initialize(int argc, const char* const* argv)
{
	CCommandLine line(
		name,
		"Optimises a pose graph: g2o (VERTEX_SE3:QUAT, EDGE_SE3:QUAT, FIX) or MRPT's .graph. Prints chi2 "
		"before and after,\n"
		"iterations, why it stopped, times and memory. Of the ini only the solver's keys of [GraphOptimizer] "
		"are used (method,\n"
		"max_iterations, min_..., threads).\n"
		"Example: auv-graph-optimize in.g2o -o out.g2o --init odometry --robust cauchy --json\n"
		"Exit status 3: the solver did not converge; the files are written and hold what it reached.",
		"The optimised graph, g2o, with the input's ids and edges (here a file, not a folder)", "OUT.g2o");
	auto& cmd = line.cmd();
	// TCLAP counts optional unlabelled arguments over the whole program, not by command line.
	TCLAP::OptionalUnlabeledTracker::alreadyOptional() = false;
	TCLAP::UnlabeledValueArg<std::string> input("graph", "The graph to optimise", false, "", "IN.g2o", cmd);
	CChoiceFlag solver(
		"solver",
		"batch: all nodes at once; incremental: node by node in the order of ids, then exact; levmarq: "
		"MRPT's own, for comparison",
		graphSolverNames(), cmd);
	CChoiceFlag start(
		"init",
		"Start poses: the file's, composed along the odometry, or by chordal initialisation from all edges",
		graphStartNames(), cmd);
	CChoiceFlag robust(
		"robust",
		"Loss of the edges that are not odometry; gnc: graduated non-convexity, keeps or rejects each whole",
		robustKernelNames(), cmd);
	TCLAP::ValueArg<double> scale(
		"", "robust-scale", "Mahalanobis distance where the robust loss departs from quadratic (default: 4)",
		false, params.robust.scale, "S", cmd);
	TCLAP::ValueArg<int> threads(
		"", "threads", "Subtrees eliminated at a time, 1 to 64; the result is the same (default: 1)", false,
		1, "N", cmd);
	TCLAP::ValueArg<std::string> weights(
		"", "weights", "Write edge,from,to,weight,chi2 of every edge", false, "", "FILE.csv", cmd);
	TCLAP::ValueArg<std::string> marginals(
		"", "marginals",
		"Write every free node's covariance (lower triangle over rho [m], phi [rad] in its own frame) and "
		"its "
		"sigmas north, east, down [m]",
		false, "", "FILE.csv", cmd);
	TCLAP::SwitchArg json("", "json", "Print one JSON object instead of text", cmd);
	if (!line.parse(argc, argv)) return false;
	if (input.getValue().substr(0, 1) == "-")  // TCLAP takes a misspelt flag for the graph
		throw CUsageError(input.getValue(), "is no flag", "see " + line.app() + " --help");

	CIniFile ini = line.ini();
	params.optimizer = optimizerOptions(ini);
	if (line.wantsConfigDump()) {
		std::cout << ini.dump();
		return false;
	}
	if (!input.isSet()) throw CUsageError("IN.g2o", "is missing", "give the graph to optimise");
	params.input = input.getValue();
	params.output = line.outputDir();
	params.solver = solver.value();
	params.start = start.value();
	if (threads.isSet()) params.optimizer.threads = checkedThreads(threads.getValue());
	params.robust = {robust.value(), scale.getValue()};
	params.weights_file = weights.getValue();
	params.marginals_file = marginals.getValue();
	params.json = json.getValue();
	m_verbosity = line.verbosity();
	refuseFlagsWithoutEffect(params, scale.isSet(), threads.isSet());
	refuseBadOutput(params);
	return true;
}

void CGraphOptimizeApp::run()
{
	m_results = {};
	CStageMeter meter;
	m_file = readGraphFile(params.input);
	meter.end("read");
	for (const auto& warning : m_file.warnings)
		std::cerr << name << ": warning: " << warning << "\n";
	namingTheFile(m_file, params.input, [&] { optimize(meter); });
	writeFiles(meter);
	report(meter);
}

void CGraphOptimizeApp::optimize(CStageMeter& meter)
{
	CPoseGraph& graph = m_file.graph;
	TResults& r = m_results;
	r.nodes = graph.nodeCount();
	r.edges = graph.edgeCount();
	r.chi2_before = chi2(graph);
	meter.end("evaluate");
	r.start = startGraph(graph, params.start);
	meter.end("initialise");
	r.chi2_start = chi2(graph);
	meter.end("evaluate");
	r.solution = solveGraph(graph, params.solver, params.optimizer, params.robust);
	meter.end("optimise");
	r.cost = meter.sum({"initialise", "optimise"});
	evaluate();
	meter.end("evaluate");
}

void CGraphOptimizeApp::evaluate()
{
	TResults& r = m_results;
	const std::vector<double> s = edgesMahalanobis2(m_file.graph);
	for (size_t k = 0; k < s.size(); k++) {
		const bool outlier = r.solution.edge_weights[k] < kOutlierWeight;
		r.chi2_after += s[k];
		if (outlier)
			r.outliers++;
		else
			r.chi2_kept += s[k];
	}
	r.reduced_chi2 = reducedChi2(m_file.graph, r.chi2_kept, s.size() - static_cast<size_t>(r.outliers));
}

void CGraphOptimizeApp::writeFiles(CStageMeter& meter)
{
	std::vector<Matrix6d> covariances;
	if (!params.marginals_file.empty()) {
		namingTheFile(
			m_file, params.input, [&] { covariances = marginalsOfAllNodes(m_file.graph, params.optimizer); });
		meter.end("marginals");
		writeMarginals(params.marginals_file, m_file, covariances);
	}
	if (!params.weights_file.empty())
		writeEdgeWeights(params.weights_file, m_file, m_results.solution.edge_weights);
	if (!params.output.empty()) writeG2o(params.output, m_file.graph, m_file.file_ids);
	meter.end("write");
	m_results.peak_memory_mb = peakMemoryMb();
}

void CGraphOptimizeApp::report(const CStageMeter& meter) const
{
	if (params.json)
		std::cout << jsonText(meter);
	else if (m_verbosity > 0)
		std::cout << text(meter);
	if (!m_results.solution.converged)
		std::cerr << name << ": warning: " << params.input << ": not converged: " << m_results.solution.status
				  << " after " << m_results.solution.iterations
				  << " iterations; try --init odometry, --robust cauchy or --set "
					 "GraphOptimizer.max_iterations=...\n";
}

std::string CGraphOptimizeApp::text(const CStageMeter& meter) const
{
	const TResults& r = m_results;
	const auto g = [](double x) { return significantText(x, 10); };
	const bool robust = params.robust.kernel != "none";
	std::string out = params.input + ": " + std::to_string(r.nodes) + " nodes, " + std::to_string(r.edges) +
					  " edges\nsolver " + params.solver + ", start from " + r.start + ", robust loss " +
					  params.robust.kernel + "\n";
	const std::string reduced = significantText(r.reduced_chi2, 4) + " a degree of freedom";
	out += "chi2 before " + g(r.chi2_before) + ", at the start " + g(r.chi2_start) + ", after " +
		   g(r.chi2_after) + (robust ? "\n" : " (" + reduced + ")\n");
	if (robust)
		out += std::to_string(r.outliers) +
			   " edges held for outliers (weight below 0.5); chi2 of the others " + g(r.chi2_kept) + " (" +
			   reduced + ")\n";
	out += r.solution.status + " after " + std::to_string(r.solution.iterations) + " iterations";
	if (r.solution.rounds > 0) out += " in the last of " + std::to_string(r.solution.rounds) + " rounds";
	CTextTable table({"stage", "CPU [s]", "wall [s]"});
	for (const auto& stage : meter.stages())
		if (stage.name != "evaluate")
			table.add({stage.name, fixedText(stage.cpu, 4), fixedText(stage.wall, 4)});
	return out + "\n\n" + table.text() + "\npeak memory " + fixedText(r.peak_memory_mb, 1) + " MB\n";
}

std::string CGraphOptimizeApp::jsonText(const CStageMeter& meter) const
{
	const TResults& r = m_results;
	nlohmann::ordered_json out{
		{"chi2_before", r.chi2_before},
		{"chi2_start", r.chi2_start},
		{"chi2_after", r.chi2_after},
		{"chi2_kept", r.chi2_kept},
		{"reduced_chi2", r.reduced_chi2},
		{"iterations", r.solution.iterations},
		{"status", r.solution.status},
		{"converged", r.solution.converged},
		{"nodes", r.nodes},
		{"edges", r.edges},
		{"solver", params.solver},
		{"init", params.start},
		{"robust", params.robust.kernel},
		{"outliers", r.outliers},
		{"rounds", r.solution.rounds},
		{"threads", params.optimizer.threads},
		{"simd", simdName()},
		{"cpu_s", r.cost.cpu},
		{"wall_s", r.cost.wall},
		{"peak_memory_mb", r.peak_memory_mb}};
	for (const char* stage : {"read", "initialise", "optimise", "marginals", "write"}) {
		const auto sum = meter.sum({stage});
		out["stages"][stage] = {{"cpu_s", sum.cpu}, {"wall_s", sum.wall}};
	}
	return out.dump(1, '\t') + "\n";
}
}  // namespace posidonia
