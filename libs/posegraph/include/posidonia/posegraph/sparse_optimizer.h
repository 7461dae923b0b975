#pragma once

#include <posidonia/base/options.h>
#include <posidonia/posegraph/marginals.h>
#include <posidonia/posegraph/system_factor.h>

#include <string>

namespace posidonia
{
struct TOptimizerOptions
{
	std::string method{"levenberg-marquardt"};
	int max_iterations{100};
	double min_relative_decrease{1e-7};
	double min_step{1e-9};
	double min_gradient{1e-9};
	double initial_damping{1e-9};
	int threads{1};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice(
			"method", method, {"levenberg-marquardt", "gauss-newton"},
			"Levenberg-Marquardt never ends worse than it began; Gauss-Newton takes every step");
		v.integer("max_iterations", max_iterations, between(1, 100000), "Linear systems solved at most");
		v.number(
			"min_relative_decrease", min_relative_decrease, atLeast(0),
			"Converged when a step lowers the cost, is predicted to, or those after it will, by less than "
			"this part of it [-]");
		v.number("min_step", min_step, atLeast(0), "Converged when no coordinate moves more [m, rad]");
		v.number(
			"min_gradient", min_gradient, atLeast(0),
			"Converged when |b_i| / sqrt(H_ii) is below this for every coordinate [-]");
		v.number(
			"initial_damping", initial_damping, above(0),
			"First Levenberg-Marquardt damping, relative to the diagonal of H [-]");
		v.integer(
			"threads", threads, between(1, 64), "Subtrees eliminated at a time; results do not depend on it");
	}
};

enum class EOptimizerStatus
{
	Converged,
	MaxIterations,	///< the poses are the best so far
	NoDecrease,		///< however damped, no step lowers the cost, yet the gradient is not small
	Diverged,		///< Gauss-Newton ended above its start; the start's poses were put back
	Singular		///< H is not positive definite to working precision; the poses are the best so far
};
const char* toString(EOptimizerStatus status);

/** What came out, and how far to trust it. */
struct TOptimizerResult
{
	EOptimizerStatus status{EOptimizerStatus::MaxIterations};
	int iterations{0};	///< linear systems solved
	TChi2 before, after;
	/** Numbers measured by edges and priors, less 6 a free node; honest information gives after.plain near
	 * it.
	 */
	int degrees_of_freedom{0};
	double predicted_decrease{0};  ///< of the robust cost, by the last linear model: what was still to gain
	double last_step{0};		   ///< largest coordinate of the last step [m, rad]
	double gradient{0};			   ///< largest |b_i| / sqrt(H_ii) at the last linearisation [-]
	int failed_node{-1};		   ///< Singular: the node where the factorisation broke down
	std::string problem;		   ///< Singular: that node and what is measured there
	std::vector<double> edge_weights;	///< of each edge's information at the end, 1 without a loss
	std::vector<double> prior_weights;	///< the same of each prior

	bool converged() const { return status == EOptimizerStatus::Converged; }
	/** after.plain / degrees_of_freedom: near 1 when the edges' information is honest. 0 without redundancy.
	 */
	double reducedChi2() const;
	/** Edges that a robust loss holds for outliers: weight below one half. */
	int downWeightedEdges() const;
};

/** Nonlinear least squares over poses and error variables (README, "Optimiser"), from the graph's present
 * states. Keep one object for a growing graph: ordering and symbolic analysis are redone only when the
 * sparsity pattern changes. The same graph gives the same bytes, whatever was optimised before. */
class CSparseOptimizer
{
   public:
	/** Throws CError for an unknown method. */
	explicit CSparseOptimizer(const TOptimizerOptions& options = {});
	CSparseOptimizer(const CSparseOptimizer&) = delete;
	CSparseOptimizer& operator=(const CSparseOptimizer&) = delete;

	/** Throws CError naming a node that neither a fixed node nor priors hold, through edges. */
	TOptimizerResult optimize(CPoseGraph& graph);

	/** Covariances at the graph's present states (linearised and factorised anew, undamped). Throws CError
	 * when H is singular or a node is not held. */
	CMarginals marginals(const CPoseGraph& graph);

	size_t symbolicAnalyses() const { return m_cholesky.analyses(); }
	const CNormalEquations& system() const { return m_system; }
	const CMultifrontalCholesky& cholesky() const { return m_cholesky; }

   private:
	/** One run's state. */
	struct TRun
	{
		CPoseGraph& graph;
		TOptimizerResult result;
		TChi2 cost;
		double mu;	   ///< damping
		double nu{2};  ///< growth of the damping at the next rejection
		double last_decrease{0};
	};

	bool iterate(TRun& run);
	bool stop(TRun& run, EOptimizerStatus status) const;
	void linearize(TRun& run);
	bool solveDamped(TRun& run);
	bool judge(TRun& run);
	bool accept(TRun& run, const TChi2& trial, bool small);
	static double decreaseToCome(const TRun& run, double decrease);
	bool reject(TRun& run, EOptimizerStatus why);
	void finish(TRun& run, const TNodeStates& start) const;
	void moveNodes(const CPoseGraph& graph);

	TOptimizerOptions m_options;
	bool m_gauss_newton;
	CMultifrontalCholesky m_cholesky;
	CNormalEquations m_system;
	CSystemFactor m_factor{m_system, m_cholesky};
	std::vector<Eigen::Isometry3d> m_marginal_poses;
	Eigen::VectorXd m_diagonal, m_step;
	TNodeStates m_trial;
};
}  // namespace posidonia
