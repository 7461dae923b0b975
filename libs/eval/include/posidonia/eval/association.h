#pragma once

#include <posidonia/base/options.h>
#include <posidonia/geometry/trajectory.h>

#include <string>
#include <vector>

namespace posidonia
{
/** How an estimate's poses find their true ones. */
struct TAssociationOptions
{
	std::string method{"interpolate"};
	double max_gap{0.5};
	double max_dt{0.02};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice(
			"association", method, {"interpolate", "nearest"},
			"True pose at an estimate's stamp: interpolated between neighbours, or the nearest one");
		v.number(
			"association_max_gap", max_gap, above(0),
			"Interpolate only between true poses no further apart than this [s]");
		v.number(
			"association_max_dt", max_dt, atLeast(0),
			"A nearest true pose is taken only within this time [s]");
	}
};

/** A pose of the estimate with the truth at its time. `est` and `truth` are the two worlds. */
struct TAssociatedPose
{
	double stamp{0};  ///< of the estimate [s]
	size_t index{0};  ///< in the estimate
	Eigen::Isometry3d T_truth_body{Eigen::Isometry3d::Identity()};
	Eigen::Isometry3d T_est_body{Eigen::Isometry3d::Identity()};
};
using TAssociation = std::vector<TAssociatedPose>;

/** Linear in position, slerp in rotation; s in [0, 1] from A to B. */
Eigen::Isometry3d interpolate(const Eigen::Isometry3d& A, const Eigen::Isometry3d& B, double s);

/** The truth at the estimate's stamps, in the estimate's order; poses without one are left out.
 * "interpolate" falls back to the nearest within max_dt where the truth does not bracket the stamp within
 * max_gap. Throws CError when a trajectory's stamps go backwards, or when nothing is associated (it says both
 * time spans). */
TAssociation associate(
	const TTrajectory& estimate, const TTrajectory& truth, const TAssociationOptions& options = {});
}  // namespace posidonia
