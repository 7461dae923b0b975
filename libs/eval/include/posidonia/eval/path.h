#pragma once

#include <posidonia/eval/association.h>

namespace posidonia
{
/** Distance travelled up to each position [m], by chords; the first is 0. Same size as the input. */
std::vector<double> travelled(const std::vector<Eigen::Vector3d>& positions);

/** Length [m] by chords. */
double pathLength(const TTrajectory& trajectory);

/** Length [m] of the part with stamps in [from, to] (whole poses, nothing interpolated). */
double pathLength(const TTrajectory& trajectory, double from, double to);

std::vector<Eigen::Vector3d> truePositions(const TAssociation& poses);
std::vector<Eigen::Vector3d> estimatedPositions(const TAssociation& poses);
}  // namespace posidonia
