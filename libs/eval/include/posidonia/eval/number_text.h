#pragma once

#include <string>

namespace posidonia
{
/** x with a fixed number of decimals, whatever the locale; never "-0.000". */
std::string fixedText(double x, int decimals);

/** x with at most `digits` significant digits, shortest form (as printf's %g), whatever the locale. */
std::string significantText(double x, int digits);
}  // namespace posidonia
