#pragma once

#include <posidonia/geometry/se3.h>
#include <posidonia/posegraph/robust_loss.h>

namespace posidonia
{
/** What was measured of one node; the map is north-east-down. */
enum class EPriorKind
{
	Position,			 ///< (north, east, down) [m]
	HorizontalPosition,	 ///< (north, east) [m], e.g. GPS
	Depth,				 ///< down [m]
	RollPitch,			 ///< direction of gravity: turn about north and east [rad], whatever the heading
	Heading,			 ///< turn about down [rad], whatever roll and pitch
	Attitude,			 ///< turn about north, east and down [rad]
	FullPose,			 ///< (rho [m], phi [rad]) in the node's own frame, as an edge's
	ErrorVariable		 ///< the value of an error variable; every one has one
};
const char* toString(EPriorKind kind);
/** Rows of the residual, 1 to 6. */
int priorDimension(EPriorKind kind);

/** An absolute measurement of one node (README, "Priors"). Only the parts of T_map_node that the kind speaks
 * of are used, except that the turns compare whole rotations: give the attitude as it was measured. */
struct TPosePrior
{
	int node{-1};
	EPriorKind kind{EPriorKind::FullPose};
	Eigen::Isometry3d T_map_node{Eigen::Isometry3d::Identity()};
	Vector6d value{Vector6d::Zero()};  ///< of the kind ErrorVariable only
	/** Inverse covariance of the residual; the top left priorDimension() rows and columns count. Those of
	 * turns are of e in R_measured = Exp(e) R, e in map axes. */
	Matrix6d information{Matrix6d::Identity()};
	TRobustLoss loss{};
	/** Node of an error c shared with other factors, or -1. The measurement is meant as measured +
	 * sensitivity c; for turns Exp(sensitivity c) R_measured, for full poses retract(T_map_node, sensitivity
	 * c).
	 */
	int error_variable{-1};
	Matrix6d sensitivity{Matrix6d::Zero()};	 ///< the first priorDimension() rows count
};
}  // namespace posidonia
