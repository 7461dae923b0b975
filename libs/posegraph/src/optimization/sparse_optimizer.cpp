#include <posidonia/base/error.h>
#include <posidonia/posegraph/sparse_optimizer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace posidonia
{
namespace
{
constexpr double kMaxDamping = 1e12;	///< steps are then far below rounding
constexpr double kDivergedRatio = 1e6;	///< Gauss-Newton may climb on its way, but not this far

/** Largest |b_i| / sqrt(H_ii); an undetermined coordinate (H_ii = 0) is infinitely far from settled. */
double largestScaledGradient(const Eigen::VectorXd& b, const Eigen::VectorXd& diagonal)
{
	double largest = 0;
	for (int i = 0; i < b.size(); i++)
		largest = std::max(
			largest, diagonal[i] > 0 ? std::abs(b[i]) / std::sqrt(diagonal[i])
									 : std::numeric_limits<double>::infinity());
	return largest;
}
}  // namespace

const char* toString(EOptimizerStatus status)
{
	switch (status) {
		case EOptimizerStatus::Converged:
			return "converged";
		case EOptimizerStatus::MaxIterations:
			return "max iterations";
		case EOptimizerStatus::NoDecrease:
			return "no decrease";
		case EOptimizerStatus::Diverged:
			return "diverged";
		case EOptimizerStatus::Singular:
			break;
	}
	return "singular";
}

double TOptimizerResult::reducedChi2() const
{
	return degrees_of_freedom > 0 ? after.plain / degrees_of_freedom : 0;
}

int TOptimizerResult::downWeightedEdges() const
{
	return int(std::count_if(edge_weights.begin(), edge_weights.end(), [](double w) { return w < 0.5; }));
}

CSparseOptimizer::CSparseOptimizer(const TOptimizerOptions& options)
	: m_options(options), m_gauss_newton(options.method == "gauss-newton"), m_cholesky(options.threads)
{
	if (!m_gauss_newton && options.method != "levenberg-marquardt")
		throw CError(
			"optimiser", "unknown method '" + options.method + "'",
			"use levenberg-marquardt or gauss-newton");
}

TOptimizerResult CSparseOptimizer::optimize(CPoseGraph& graph)
{
	m_system.followStructure(graph, m_cholesky);
	const TNodeStates start = graph.states();
	TRun run{graph, {}, {}, m_gauss_newton ? 0 : m_options.initial_damping};
	linearize(run);
	run.result.before = run.cost;
	while (iterate(run)) {
	}
	finish(run, start);
	return run.result;
}

/** One linear system: solve, try the step, take or leave it. False when done. */
bool CSparseOptimizer::iterate(TRun& run)
{
	if (run.result.gradient <= m_options.min_gradient) return stop(run, EOptimizerStatus::Converged);
	if (run.result.iterations == m_options.max_iterations) return stop(run, EOptimizerStatus::MaxIterations);
	run.result.iterations++;
	if (!solveDamped(run)) return reject(run, EOptimizerStatus::Singular);
	moveNodes(run.graph);
	return judge(run);
}

bool CSparseOptimizer::stop(TRun& run, EOptimizerStatus status) const
{
	run.result.status = status;
	return false;
}

void CSparseOptimizer::linearize(TRun& run)
{
	run.cost = m_system.linearize(run.graph);
	m_diagonal = m_system.H().diagonal();
	run.result.gradient = largestScaledGradient(m_system.b(), m_diagonal);
}

/** (H + mu diag H) d = b. Marquardt's scaling makes the damping independent of metres and radians. */
bool CSparseOptimizer::solveDamped(TRun& run)
{
	m_system.H().setDiagonal((1 + run.mu) * m_diagonal);
	if (!m_cholesky.factorize(m_system.H(), m_system.b())) {
		run.result.failed_node = m_system.nodeOf(m_cholesky.failedBlock());
		return false;
	}
	m_step = m_cholesky.solve();
	run.result.last_step = m_step.lpNorm<Eigen::Infinity>();
	// Madsen, Nielsen, Tingleff 2004, eq. (2.18)
	run.result.predicted_decrease = m_step.dot(run.mu * m_diagonal.cwiseProduct(m_step) + m_system.b());
	return m_step.allFinite();
}

void CSparseOptimizer::moveNodes(const CPoseGraph& graph)
{
	m_trial = graph.states();
	for (int column = 0; column < m_system.freeNodeCount(); column++) {
		const int node = m_system.nodeOf(column);
		retractNode(graph.nodeKind(node), m_step.segment<6>(6 * column), node, m_trial);
	}
}

bool CSparseOptimizer::judge(TRun& run)
{
	const TChi2 trial = chi2At(run.graph, m_trial);
	const bool small = run.result.last_step <= m_options.min_step ||
					   run.result.predicted_decrease <= m_options.min_relative_decrease * run.cost.robust;
	if (m_gauss_newton && !(trial.robust <= kDivergedRatio * run.result.before.robust))
		return stop(run, EOptimizerStatus::Diverged);
	if (trial.robust <= run.cost.robust || (m_gauss_newton && !small)) return accept(run, trial, small);
	// A step predicted to gain next to nothing that loses next to nothing: rounding, at the minimum.
	if (small) return stop(run, EOptimizerStatus::Converged);
	return reject(run, EOptimizerStatus::NoDecrease);
}

bool CSparseOptimizer::accept(TRun& run, const TChi2& trial, bool small)
{
	const double decrease = run.cost.robust - trial.robust;
	small |= std::min(std::abs(decrease), decreaseToCome(run, decrease)) <=
			 m_options.min_relative_decrease * run.cost.robust;
	run.last_decrease = decrease;
	run.graph.setStates(m_trial);
	run.cost = trial;
	if (small) return stop(run, EOptimizerStatus::Converged);
	if (!m_gauss_newton) {
		// Nielsen 1999: continuous in the gain, never below a third.
		const double gain = decrease / run.result.predicted_decrease;
		run.mu *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
		run.nu = 2;
	}
	linearize(run);
	return true;
}

/** Where steps do what the linear model predicts and decreases fall by a factor of ten or more, those to come
 * sum up to less than a geometric series of the last factor. */
double CSparseOptimizer::decreaseToCome(const TRun& run, double decrease)
{
	const double factor = decrease / run.last_decrease;
	const bool as_predicted = std::abs(decrease - run.result.predicted_decrease) < 0.1 * decrease;
	if (!as_predicted || !(factor > 0 && factor < 0.1)) return std::numeric_limits<double>::infinity();
	return decrease * factor / (1 - factor);
}

bool CSparseOptimizer::reject(TRun& run, EOptimizerStatus why)
{
	run.mu *= run.nu;
	run.nu *= 2;
	if (m_gauss_newton || run.mu > kMaxDamping) return stop(run, why);
	return true;
}

void CSparseOptimizer::finish(TRun& run, const TNodeStates& start) const
{
	TOptimizerResult& result = run.result;
	if (m_gauss_newton && !(run.cost.robust <= result.before.robust) && !result.converged())
		result.status = EOptimizerStatus::Diverged;
	if (result.status == EOptimizerStatus::Diverged) run.graph.setStates(start);
	if (result.status == EOptimizerStatus::Singular)
		result.problem =
			"the information matrix is singular at " + describeNode(run.graph, result.failed_node);
	else
		result.failed_node = -1;
	const auto weigh = [&result](const TRobustLoss& loss, double s) {
		result.after.plain += s;
		result.after.robust += robustCost(loss, s);
		return robustWeight(loss, s);
	};
	const auto edges = edgesMahalanobis2(run.graph), priors = priorsMahalanobis2(run.graph);
	result.degrees_of_freedom = 6 * (int(edges.size()) - m_system.freeNodeCount());
	for (size_t k = 0; k < edges.size(); k++)
		result.edge_weights.push_back(weigh(run.graph.edges()[k].loss, edges[k]));
	for (size_t k = 0; k < priors.size(); k++) {
		const TPosePrior& prior = run.graph.priors()[k];
		result.prior_weights.push_back(weigh(prior.loss, priors[k]));
		result.degrees_of_freedom += priorDimension(prior.kind);
	}
}

CMarginals CSparseOptimizer::marginals(const CPoseGraph& graph)
{
	m_system.followStructure(graph, m_cholesky);
	m_system.linearize(graph);
	if (m_system.freeNodeCount() > 0 && !m_cholesky.factorize(m_system.H(), m_system.b()))
		throw CError(
			describeNode(graph, m_system.nodeOf(m_cholesky.failedBlock())),
			"the information matrix is singular to working precision there",
			"look for a degree of freedom that nothing measures, or for very unequal information");
	m_marginal_poses = graph.poses();
	return CMarginals(m_marginal_poses, m_factor);
}
}  // namespace posidonia
