#pragma once

#include <posidonia/geometry/se3.h>

#include <vector>

namespace posidonia
{
/** What a node of the graph is; each kind is one 6x6 block of the normal equations. */
enum class ENodeKind
{
	Pose,		   ///< T_map_node, perturbed in its own frame (geometry/se3.h)
	ErrorVariable  ///< six numbers shared by many factors (a scale, a bias, a mounting angle ...), additive
};

/** The values of all nodes. Both arrays have an entry a node; that of the other kind stays at its default. */
struct TNodeStates
{
	std::vector<Eigen::Isometry3d> poses;  ///< T_map_node
	std::vector<Vector6d> values;		   ///< error variables [their factors' units]
};

/** Moves a node by d: a pose to retract(T, d), orthonormalised; an error variable to value + d. */
void retractNode(ENodeKind kind, const Vector6d& d, int node, TNodeStates& states);
}  // namespace posidonia
