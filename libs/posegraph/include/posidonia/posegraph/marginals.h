#pragma once

#include <posidonia/geometry/se3.h>
#include <posidonia/posegraph/clique_factor.h>

namespace posidonia
{
/** Covariances of poses at one linearisation, from the optimiser's factor; robust losses count with their
 * weights there. Made by CSparseOptimizer::marginals(); good until that optimiser is used again or destroyed
 * (using an outdated one is a CError). A fixed node has covariance zero. */
class CMarginals
{
   public:
	/** @param poses T_map_node where L was made; both must outlive this */
	CMarginals(const std::vector<Eigen::Isometry3d>& poses, const CCliqueFactor& factor)
		: m_poses(&poses), m_factor(&factor), m_version(factor.version())
	{
	}

	/** 6x6 covariance of (rho, phi) of T_map_node: from the cliques on the way to the root alone. */
	Matrix6d covarianceOf(int node) const;

	/** The same of every node at once, by Takahashi's recursion down the forest: some two factorisations. */
	std::vector<Matrix6d> allCovariances() const;

	/** 6x6 covariance of (rho, phi) of T_i_j = inverse(T_map_i) T_map_j, from the joint marginal of both. */
	Matrix6d relativeCovariance(int i, int j) const;

	/** relativeCovariance(i, j) for one j against many i. */
	std::vector<Matrix6d> relativeCovariances(const std::vector<int>& is, int j) const;

	/** Covariance of several nodes together, 6k x 6k, in the order given. */
	Eigen::MatrixXd jointCovariance(const std::vector<int>& nodes) const;

   private:
	using TColumns = Eigen::Matrix<double, Eigen::Dynamic, 6>;
	/** L^-1 times a node's unit columns: what is not zero of it, clique by clique towards the root. */
	struct THalfColumns
	{
		std::vector<int> cliques;
		std::vector<TColumns> values;  ///< 6 pivots x 6 each
	};

	THalfColumns halfColumns(int node) const;
	static Matrix6d product(const THalfColumns& a, const THalfColumns& b);
	void requireUsable(int node) const;

	const std::vector<Eigen::Isometry3d>* m_poses;
	const CCliqueFactor* m_factor;
	size_t m_version;
};
}  // namespace posidonia
