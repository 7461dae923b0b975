#pragma once

#include <posidonia/eval/association.h>

#include <array>
#include <string>

namespace posidonia
{
/** What may be fitted before an error is measured, from nothing to everything. */
enum class EAlignment
{
	None,		  ///< the worlds are taken as the same: what a vehicle that navigates feels
	Origin,		  ///< the first associated pose is made right
	YawPosition,  ///< 4 degrees of freedom, least squares of positions; gravity (z) is kept
	SE3,		  ///< 6 degrees of freedom, least squares of positions (Umeyama 1991, without scale)
};

/** In the order of report: unaligned first. */
constexpr std::array<EAlignment, 4> kAlignments{
	EAlignment::None, EAlignment::Origin, EAlignment::YawPosition, EAlignment::SE3};

/** "unaligned", "origin", "yaw_position", "se3": as metrics are named. */
std::string alignmentName(EAlignment kind);

/** "unaligned", "origin aligned", "yaw+position aligned", "SE(3) aligned": as people read it. */
std::string alignmentTitle(EAlignment kind);

/** T_truth_est, which maps the estimate's world to the truth's. For positions on one straight line the
 * rotation about it is free (SE3): some optimum comes back. Throws CError for no poses. */
Eigen::Isometry3d align(EAlignment kind, const TAssociation& poses);
}  // namespace posidonia
