#pragma once

#include <posidonia/posegraph/pose_graph.h>

#include <string>

namespace posidonia::bench
{
/** What a solver reached; the graph's poses are its own. */
struct TPeerResult
{
	int iterations{0};
	bool converged{false};
};

struct TCeresOptions
{
	/** Analytic: this project's Jacobians on one 6-dof block a node. Otherwise automatic ones on (t, q) with
	 * Ceres' own quaternion manifold. */
	bool analytic{true};
	double initial_radius{1e16};  ///< Of the trust region; Ceres' own default is 1e4
	double function_tolerance{1e-6};
	bool jacobi_scaling{true};
};

/** The same residual, whitened, by Ceres: Levenberg-Marquardt, SPARSE_NORMAL_CHOLESKY, SuiteSparse, one
 * thread. */
TPeerResult optimizeWithCeres(CPoseGraph& graph, const TCeresOptions& options);

/** One thread in OpenBLAS and in CHOLMOD's OpenMP loops, for every solver of the process. */
void useOneThread();

/** The BLAS that is linked: OpenBLAS' own words, or that it is another. */
std::string blasText();
}  // namespace posidonia::bench
