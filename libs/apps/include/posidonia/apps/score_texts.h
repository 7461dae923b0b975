#pragma once

#include <posidonia/apps/scoring.h>

namespace posidonia
{
/** Tables of the absolute errors after `alignments`, the relative errors, the lengths and the loops. */
std::string scoresText(const TRunScores& scores, const std::vector<EAlignment>& alignments);

/** "none", "origin", "yaw_position", "se3" or "all". Throws CUsageError for another name. */
std::vector<EAlignment> alignmentsOf(const std::string& name);
}  // namespace posidonia
