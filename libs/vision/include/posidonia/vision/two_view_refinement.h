#pragma once

#include <posidonia/geometry/se3.h>
#include <posidonia/vision/key_frame.h>

#include <utility>
#include <vector>

namespace posidonia
{
/** Tukey's biweight on the squared, whitened residual s of a whole point; beyond `cutoff` a point has no say.
 */
struct TTukeyLoss
{
	double cutoff{32};	///< [sigma^2]

	double cost(double s) const;
	/** d cost / d s, in [0, 1]. */
	double weight(double s) const;
	/** Information kept when residuals are Gaussian with `dof` degrees of freedom, < 1 (README, section 5).
	 */
	double efficiency(int dof) const;
};

/** Where a relative pose stands: everything is told for T_a_b perturbed in its own frame (rho, phi). */
struct TLinearisation
{
	Matrix6d H{Matrix6d::Zero()};  ///< Robustly weighted, points eliminated
	Vector6d g{Vector6d::Zero()};  ///< Gradient of half the cost
	double cost{0};				   ///< Sum of the loss over the points
};

/** Relative pose of two key frames and the points seen by both, from all four images (README, section 5).
 * Each point has 6 measurements: (u, v, disparity) in a and in b, with the key frames' own noise. For a given
 * pose the best position of every point is found first, so the cost is one of the pose alone ("profile"). */
class CTwoViewRefinement
{
   public:
	using Matches = std::vector<std::pair<int, int>>;

	/** @param matches (index in a, index in b); key frames and camera must outlive the object */
	CTwoViewRefinement(
		const TStereoCamera& camera, const TKeyFrame& a, const TKeyFrame& b, const Matches& matches);

	/** Minimum over T_a_b of the sum of losses, Levenberg-Marquardt from `start`, with the cut-off brought
	 * down to `loss.cutoff` in steps. @return false if it doesn't converge (step below 1e-10 m and rad) */
	bool solve(const Eigen::Isometry3d& start, const TTukeyLoss& loss, Eigen::Isometry3d& T_a_b);

	/** Cost, gradient and Gauss-Newton matrix at a pose. */
	TLinearisation linearise(const Eigen::Isometry3d& T_a_b, const TTukeyLoss& loss);

	/** Squared whitened residual of each match at a pose, its point at its best: chi2 with 3 degrees of
	 * freedom. */
	const std::vector<double>& chi2(const Eigen::Isometry3d& T_a_b);

	/** Information (rho, phi) of one match on T_a_b, all weights 1, its point eliminated. */
	Matrix6d information(const Eigen::Isometry3d& T_a_b, int match) const;

	/** Residual (u, v, d in a; u, v, d in b) [px] of a match, its point at its best. */
	Vector6d residual(const Eigen::Isometry3d& T_a_b, int match) const;

   private:
	/** A match: measurements, their weights, and the present estimate of the point in a. */
	struct TTrack
	{
		Eigen::Vector3d z_a, z_b;	   // (u, v, d) [px]
		Eigen::Vector3d w_a, w_b;	   // 1 / sigma^2
		Eigen::Vector3d start, point;  // [m] in a
	};
	struct TPointTerms;

	void settlePoint(const Eigen::Isometry3d& T_b_a, TTrack& track) const;
	TPointTerms terms(const Eigen::Isometry3d& T_b_a, const TTrack& track) const;
	void settle(const Eigen::Isometry3d& T_a_b);
	bool descend(const TTukeyLoss& loss, int max_iterations, double stop, Eigen::Isometry3d& T_a_b);

	TStereoCamera m_camera;
	std::vector<TTrack> m_tracks;
	std::vector<double> m_chi2;
};
}  // namespace posidonia
