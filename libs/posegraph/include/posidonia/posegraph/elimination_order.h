#pragma once

#include <vector>

#include <array>

namespace posidonia
{
/** Fill-reducing elimination order by approximate minimum degree (Amestoy, Davis, Duff 2004; SuiteSparse's AMD).
 * Ordering blocks instead of scalars costs 1/36. order[k] = the variable eliminated k-th.
 * @param pairs (a, b), a < b, of coupled variables, sorted, each once */
std::vector<int> minimumDegreeOrder(int n, const std::vector<std::array<int, 2>>& pairs);
}  // namespace posidonia
