#pragma once

#include <posidonia/geometry/se3.h>
#include <posidonia/graphslam/slam_options.h>

#include <optional>
#include <string>

namespace posidonia
{
/** What the graph says of T_i_j before a registration of the pair is believed. */
struct TRelativePrediction
{
	Eigen::Isometry3d T_i_j{Eigen::Isometry3d::Identity()};
	Matrix6d covariance{Matrix6d::Zero()};	///< Over (rho, phi) of T_i_j
};

/** The larger, axis by axis of the map, of a prediction's translation covariance and of a drift that does not
 * average out: `drift_variance` [m^2] north, east, down. An axis where the drift is larger loses its
 * correlations.
 * @param R_map_j attitude of body j */
Matrix6d largerOfGraphAndDrift(
	const Matrix6d& covariance, const Eigen::Matrix3d& R_map_j, const Eigen::Vector3d& drift_variance);

/** Decides whether a registration agrees with what the graph already knows. */
class CLoopGate
{
   public:
	explicit CLoopGate(const TGateOptions& options);

	/** Empty when it passes, else the reason for loops.csv. `information` is the registration's. */
	std::optional<std::string> refuse(
		const TRelativePrediction& prediction, const Eigen::Isometry3d& T_i_j,
		const Matrix6d& information) const;

	/** Squared Mahalanobis distance between measurement and prediction, covariances added, floors applied. */
	double mahalanobis2(
		const TRelativePrediction& prediction, const Eigen::Isometry3d& T_i_j,
		const Matrix6d& information) const;

	double threshold() const { return m_threshold; }
	bool needsCovariance() const { return m_options.kind == "mahalanobis"; }

   private:
	TGateOptions m_options;
	double m_threshold;	 // chi-square quantile, 6 degrees of freedom
};
}  // namespace posidonia
