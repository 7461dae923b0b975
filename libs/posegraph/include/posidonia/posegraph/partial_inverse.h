#pragma once

#include <posidonia/geometry/se3.h>
#include <posidonia/posegraph/clique_factor.h>
#include <posidonia/posegraph/large_buffer.h>

namespace posidonia
{
/** Diagonal blocks of H^-1, from L alone (Takahashi, Fagan, Chin 1973; Erisman, Tinney 1975): down the
 * forest, each clique's part of the inverse follows from its parent's. @param blocks of each node; those of
 * fixed nodes stay */
void inverseDiagonalBlocks(const CCliqueFactor& factor, std::vector<Matrix6d>& blocks);
}  // namespace posidonia
