#pragma once

#include <posidonia/posegraph/normal_equations.h>

namespace posidonia
{
/** Covariances of poses at one linearisation, from the optimiser's factor; robust losses count with their
 * weights there. Made by CSparseOptimizer::marginals(); good until that optimiser is used again or destroyed
 * (using an outdated one is a CError). A fixed node has covariance zero. */
class CMarginals
{
   public:
	CMarginals(const CPoseGraph& graph, const CNormalEquations& system, CSparseCholesky& cholesky);

	/** 6x6 covariance of (rho, phi) of T_map_node. */
	Matrix6d covarianceOf(int node) const;

	/** 6x6 covariance of (rho, phi) of T_i_j = inverse(T_map_i) T_map_j, from the joint marginal of both. */
	Matrix6d relativeCovariance(int i, int j) const;

	/** relativeCovariance(i, j) for one j against many i: j's columns are solved once, the others together.
	 */
	std::vector<Matrix6d> relativeCovariances(const std::vector<int>& is, int j) const;

	/** Covariance of several nodes together, 6k x 6k, in the order given. */
	Eigen::MatrixXd jointCovariance(const std::vector<int>& nodes) const;

   private:
	Eigen::MatrixXd halfColumns(const int* nodes, size_t count) const;
	void requireUsable(int node) const;

	std::vector<Eigen::Isometry3d> m_poses;
	const CNormalEquations* m_system;
	CSparseCholesky* m_cholesky;
	size_t m_factorization;	 ///< which of the solver's factorisations this speaks of
};
}  // namespace posidonia
