#pragma once

#include <vector>

#include <array>

namespace posidonia
{
/** Fill-reducing elimination order by approximate minimum degree (Amestoy, Davis, Duff 2004; SuiteSparse's
 * AMD). Ordering blocks instead of scalars costs 1/36. order[k] = the variable eliminated k-th.
 * @param pairs (a, b) of coupled variables; may come again */
std::vector<int> minimumDegreeOrder(int n, const std::vector<std::array<int, 2>>& pairs);

/** The same where variables of a lower group are eliminated before those of a higher one (SuiteSparse's
 * CAMD).
 * @param groups of each variable, 0 .. n - 1 */
std::vector<int> constrainedMinimumDegreeOrder(
	int n, const std::vector<std::array<int, 2>>& pairs, const std::vector<int>& groups);
}  // namespace posidonia
