#pragma once

#include <cstddef>

namespace posidonia::testing
{
/** How often operator new has been called in this program (Eigen's own aligned allocations are not in it). */
size_t allocations();
}  // namespace posidonia::testing
