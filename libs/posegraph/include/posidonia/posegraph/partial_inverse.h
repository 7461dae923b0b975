#pragma once

#include <posidonia/posegraph/multifrontal_cholesky.h>

namespace posidonia
{
/** Diagonal blocks of H^-1 in elimination order, from L alone (Takahashi, Fagan, Chin 1973; Erisman, Tinney 1975): down
 * the forest, each clique's part of the inverse follows from its parent's. */
std::vector<Matrix6d> inverseDiagonalBlocks(const CMultifrontalCholesky& cholesky);
}  // namespace posidonia
