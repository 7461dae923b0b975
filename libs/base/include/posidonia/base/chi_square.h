#pragma once

namespace posidonia
{
/** Quantile of the chi-square distribution, 0 < p < 1, degrees of freedom >= 1: closed forms, bisected
 * (mrpt::math::chi2inv approximates, 1 to 3 % off at 99.9 %). */
double chiSquareQuantile(double p, int degrees_of_freedom);
}  // namespace posidonia
