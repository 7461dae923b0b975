#pragma once

#include <posidonia/eval/alignment.h>
#include <posidonia/eval/statistics.h>

namespace posidonia
{
/** Error of one pose after alignment. */
struct TPoseError
{
	double stamp{0};				 ///< [s]
	double distance{0};				 ///< travelled along the truth up to here [m]
	Eigen::Vector3d error{0, 0, 0};	 ///< estimated minus true position, in the truth's world [m]
	double translation{0};			 ///< |error| [m]
	double rotation{0};				 ///< angle between true and estimated attitude [rad], in [0, pi]
};

/** Absolute trajectory error (Sturm et al. 2012), at pose level. */
struct TAbsoluteError
{
	EAlignment alignment{EAlignment::None};
	Eigen::Isometry3d T_truth_est{Eigen::Isometry3d::Identity()};
	std::vector<TPoseError> poses;	///< one an associated pose, in order
	TStatistics translation;		///< [m]
	TStatistics rotation;			///< [rad]

	double endError() const { return poses.back().translation; }  ///< at the last associated pose [m]
};

/** Throws CError for no poses. */
TAbsoluteError absoluteError(const TAssociation& poses, EAlignment kind);
}  // namespace posidonia
