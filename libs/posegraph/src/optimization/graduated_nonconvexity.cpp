#include <posidonia/base/chi_square.h>
#include <posidonia/posegraph/chordal_initialization.h>
#include <posidonia/posegraph/edge_support.h>
#include <posidonia/posegraph/graduated_nonconvexity.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace posidonia
{
namespace
{
constexpr int kTruncations = 20;  ///< of the final alternation; two or three suffice
/** Is there a pose for chordal initialisation to start from? */
bool hasAnchor(const CPoseGraph& graph)
{
	for (int node = 0; node < int(graph.nodeCount()); node++)
		if (graph.isFixed(node) && graph.nodeKind(node) == ENodeKind::Pose) return true;
	return false;
}

/** A round needs to follow its optimum, not to reach it. */
TOptimizerOptions coarseOptions(int threads)
{
	TOptimizerOptions options;
	options.max_iterations = 5;
	options.min_relative_decrease = 1e-3;
	options.threads = threads;
	return options;
}
}  // namespace

std::vector<int> TGncResult::rejectedEdges() const
{
	std::vector<int> out;
	for (size_t k = 0; k < edge_weights.size(); k++)
		if (edge_weights[k] < 0.5) out.push_back(int(k));
	return out;
}

double gncWeight(double s, double threshold2, double mu)
{
	if (s <= mu / (mu + 1) * threshold2) return 1;
	if (s >= (mu + 1) / mu * threshold2) return 0;
	return std::sqrt(threshold2 / s * mu * (mu + 1)) - mu;
}

CGraduatedNonconvexity::CGraduatedNonconvexity(const TGncOptions& options, const TOptimizerOptions& final)
	: m_options(options),
	  m_threshold2(chiSquareQuantile(options.inlier_probability, 6)),
	  m_coarse(coarseOptions(final.threads)),
	  m_final(final)
{
}

TGncResult CGraduatedNonconvexity::optimize(CPoseGraph& graph)
{
	std::vector<int> odometry;
	for (int k = 0; k < int(graph.edgeCount()); k++)
		if (std::abs(graph.edge(k).from - graph.edge(k).to) == 1) odometry.push_back(k);
	return optimize(graph, odometry);
}

TGncResult CGraduatedNonconvexity::optimize(CPoseGraph& graph, const std::vector<int>& trusted)
{
	std::vector<char> is_trusted(graph.edgeCount(), 0);
	for (const int k : trusted) {
		graph.edge(k);
		is_trusted[k] = 1;
	}
	TRun run{graph, trusted, {}, {}};
	run.result.edge_weights.assign(graph.edgeCount(), 1.0);
	for (int k = 0; k < int(graph.edgeCount()); k++) {
		if (is_trusted[k]) continue;
		run.open.push_back(k);
		graph.setLoss(k, {});
	}
	if (!startFromSupported(run)) {
		anneal(run, startFromAll(run));
		truncate(run);
		return run.result;
	}
	return bestOf(run, {0.1, 0.01});
}

/** Anneals from the present states with each first mu and keeps what the truncated cost says is best. A
 * larger mu trusts the start more; where loops are few and far between, it cuts true ones off. */
TGncResult CGraduatedNonconvexity::bestOf(TRun& run, const std::vector<double>& mus)
{
	const TNodeStates start = run.graph.states();
	TNodeStates best_states;
	TGncResult best;
	double lowest = std::numeric_limits<double>::infinity();
	for (const double mu : mus) {
		run.graph.setStates(start);
		run.result.rounds = 0;
		anneal(run, mu);
		truncate(run);
		const double cost = truncatedCost(run);
		if (!(cost < lowest)) continue;
		lowest = cost;
		best = run.result;
		best_states = run.graph.states();
	}
	run.graph.setStates(best_states);
	for (const int k : run.open)
		run.graph.setLoss(k, {ERobustLoss::None, 1.0, best.edge_weights[k]});
	return best;
}

/** What GNC minimises: each refused edge costs the threshold. */
double CGraduatedNonconvexity::truncatedCost(const TRun& run) const
{
	double refused = 0;
	for (const int k : run.open)
		refused += 1 - run.result.edge_weights[k];
	return chi2At(run.graph, run.graph.states()).robust + m_threshold2 * refused;
}

/** Puts the poses where the edges that confirm one another have their optimum; false when there are none.
 * From dead reckoning with all edges the rotations fold into a local minimum as soon as drift and outliers
 * are large. */
bool CGraduatedNonconvexity::startFromSupported(TRun& run)
{
	const auto supported = supportedEdges(run.graph, run.trusted, run.open, m_threshold2);
	if (supported.empty()) return false;
	std::vector<int> used = run.trusted;
	used.insert(used.end(), supported.begin(), supported.end());
	CPoseGraph sure = run.graph.withEdges(used);
	if (hasAnchor(sure)) initializeChordal(sure);
	m_final.optimize(sure);
	run.graph.setStates(sure.states());
	return true;
}

/** The paper's start (remark 5); mu below zero: every edge is within the threshold. */
double CGraduatedNonconvexity::startFromAll(TRun& run)
{
	if (run.open.empty()) return -1;
	m_coarse.optimize(run.graph);
	const auto distances = edgesMahalanobis2(run.graph);
	double largest = 0;
	for (const int k : run.open)
		largest = std::max(largest, distances[k]);
	return m_threshold2 / (2 * largest - m_threshold2);
}

/** Rounds of re-weigh, optimise, raise mu, until every weight is 0 or 1 (Yang et al. 2020, algorithm 1). */
void CGraduatedNonconvexity::anneal(TRun& run, double mu)
{
	run.result.settled = mu < 0;
	for (; run.result.rounds < m_options.max_rounds && !run.result.settled; mu *= m_options.convexity_factor)
	{
		run.result.settled = reweigh(run, mu);
		run.result.rounds++;
		optimizeWeighted(run, m_coarse);
	}
}

/** True when every weight is 0 or 1. */
bool CGraduatedNonconvexity::reweigh(TRun& run, double mu) const
{
	const auto distances = edgesMahalanobis2(run.graph);
	bool binary = true;
	for (const int k : run.open) {
		const double w = run.result.edge_weights[k] = gncWeight(distances[k], m_threshold2, mu);
		run.graph.setLoss(k, {ERobustLoss::None, 1.0, w});
		binary &= w == 0 || w == 1;
	}
	return binary;
}

/** Without the edges of weight 0: wrong ones between far nodes would fill the factor. */
void CGraduatedNonconvexity::optimizeWeighted(TRun& run, CSparseOptimizer& optimizer) const
{
	std::vector<int> used;
	for (int k = 0; k < int(run.graph.edgeCount()); k++)
		if (run.result.edge_weights[k] > 0) used.push_back(k);
	CPoseGraph active = run.graph.withEdges(used);
	run.result.optimum = optimizer.optimize(active);
	run.graph.setStates(active.states());
	std::vector<double> weights(run.graph.edgeCount(), 0.0);
	for (size_t i = 0; i < used.size(); i++)
		weights[used[i]] = run.result.optimum.edge_weights[i];
	run.result.optimum.edge_weights = weights;
}

/** Optimise exactly and keep what is within the threshold, until that set stays: each step lowers the
 * truncated cost. */
void CGraduatedNonconvexity::truncate(TRun& run)
{
	for (int i = 0; i < kTruncations; i++) {
		const auto distances = edgesMahalanobis2(run.graph);
		bool same = i > 0;
		for (const int k : run.open) {
			const double w = distances[k] <= m_threshold2 ? 1 : 0;
			same &= w == run.result.edge_weights[k];
			run.result.edge_weights[k] = w;
			run.graph.setLoss(k, {ERobustLoss::None, 1.0, w});
		}
		if (same) return;
		optimizeWeighted(run, m_final);
	}
}
}  // namespace posidonia
