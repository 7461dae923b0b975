#include <posidonia/base/error.h>
#include <posidonia/posegraph/sparse_optimizer.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
namespace
{
constexpr double kMaxDamping = 1e12;	///< steps are then far below rounding
constexpr double kDivergedRatio = 1e6;	///< Gauss-Newton may climb on its way, but not this far
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
	: m_options(options), m_gauss_newton(options.method == "gauss-newton")
{
	if (!m_gauss_newton && options.method != "levenberg-marquardt")
		throw CError(
			"optimiser", "unknown method '" + options.method + "'",
			"use levenberg-marquardt or gauss-newton");
}

TOptimizerResult CSparseOptimizer::optimize(CPoseGraph& graph)
{
	m_system.followStructure(graph, m_cholesky);
	const std::vector<Eigen::Isometry3d> start = graph.poses();
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
	movePoses(run.graph);
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
	run.result.gradient =
		m_diagonal.size() == 0 ? 0 : (m_system.b().array() / m_diagonal.array().sqrt()).abs().maxCoeff();
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

void CSparseOptimizer::movePoses(const CPoseGraph& graph)
{
	m_trial = graph.poses();
	for (int column = 0; column < m_system.freeNodeCount(); column++) {
		auto& T = m_trial[m_system.nodeOf(column)];
		T = orthonormalized(retract(T, m_step.segment<6>(6 * column)));
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
	small |= std::abs(decrease) <= m_options.min_relative_decrease * run.cost.robust;
	run.graph.setPoses(m_trial);
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

bool CSparseOptimizer::reject(TRun& run, EOptimizerStatus why)
{
	run.mu *= run.nu;
	run.nu *= 2;
	if (m_gauss_newton || run.mu > kMaxDamping) return stop(run, why);
	return true;
}

void CSparseOptimizer::finish(TRun& run, const std::vector<Eigen::Isometry3d>& start) const
{
	TOptimizerResult& result = run.result;
	if (m_gauss_newton && !(run.cost.robust <= result.before.robust) && !result.converged())
		result.status = EOptimizerStatus::Diverged;
	if (result.status == EOptimizerStatus::Diverged) run.graph.setPoses(start);
	if (result.status != EOptimizerStatus::Singular) result.failed_node = -1;
	const auto distances = edgesMahalanobis2(run.graph);
	for (size_t k = 0; k < distances.size(); k++) {
		const TRobustLoss& loss = run.graph.edges()[k].loss;
		result.edge_weights.push_back(robustWeight(loss, distances[k]));
		result.after.plain += distances[k];
		result.after.robust += robustCost(loss, distances[k]);
	}
	result.degrees_of_freedom = 6 * (int(run.graph.edgeCount()) - m_system.freeNodeCount());
}

CMarginals CSparseOptimizer::marginals(const CPoseGraph& graph)
{
	m_system.followStructure(graph, m_cholesky);
	m_system.linearize(graph);
	if (m_system.freeNodeCount() > 0 && !m_cholesky.factorize(m_system.H(), m_system.b()))
		throw CError(
			"node " + std::to_string(m_system.nodeOf(m_cholesky.failedBlock())),
			"the information matrix is singular to working precision there",
			"look for edges of very unequal information");
	return CMarginals(graph, m_system, m_cholesky);
}
}  // namespace posidonia
