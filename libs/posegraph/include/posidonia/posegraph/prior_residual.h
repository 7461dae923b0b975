#pragma once

#include <posidonia/posegraph/factor_normal.h>

/** The residual of a prior and its derivatives (README, "Priors"). */
namespace posidonia
{
/** Rows beyond priorDimension() are zero. */
struct TPriorJacobians
{
	Vector6d e;
	Matrix6d J_node, J_error;  ///< with respect to retractNode() of the node, and to c + d_c
};

/** State minus corrected measurement. */
Vector6d priorResidual(const TPosePrior& prior, const TNodeStates& states);

TPriorJacobians priorJacobians(const TPosePrior& prior, const TNodeStates& states);
}  // namespace posidonia
