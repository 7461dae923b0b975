#pragma once

#include <posidonia/geometry/se3.h>
#include <posidonia/posegraph/robust_loss.h>

namespace posidonia
{
/** A relative pose measured between two nodes. */
struct TPoseEdge
{
	int from{-1}, to{-1};
	Eigen::Isometry3d T_from_to{Eigen::Isometry3d::Identity()};
	/** Inverse covariance of the right perturbation (rho [m], phi [rad]) of T_from_to, so in `to`'s own frame
	 * (see geometry/se3.h). */
	Matrix6d information{Matrix6d::Identity()};
	TRobustLoss loss{};
	/** Node of an error c that this measurement shares with others, or -1: the measurement is then meant as
	 * retract(T_from_to, sensitivity c). */
	int error_variable{-1};
	/** d(rho, phi) of T_from_to / d c, 6 x 6; without columns where there is no error variable, since a large
	 * graph has many edges. */
	Eigen::Matrix<double, 6, Eigen::Dynamic> sensitivity{6, 0};
};

/** The edge's measurement with the shared error taken out. @param c value of its error variable */
inline Eigen::Isometry3d correctedMeasurement(const TPoseEdge& edge, const Vector6d& c)
{
	return edge.error_variable < 0 ? edge.T_from_to : retract(edge.T_from_to, edge.sensitivity * c);
}
}  // namespace posidonia
