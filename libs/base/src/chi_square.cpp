#include <posidonia/base/chi_square.h>

#include <cmath>

namespace posidonia
{
namespace
{
/** P(chi-square > x), with h = x/2: erfc(sqrt(h)) when the degrees of freedom are odd, and one term
 * exp(-h) h^k / Gamma(k + 1) for each k = dof/2 - 1, dof/2 - 2, ... >= 0 (Abramowitz, Stegun, 26.4.4-5). */
double chiSquareTail(double x, int dof)
{
	const double h = x / 2;
	double tail = dof % 2 == 1 ? std::erfc(std::sqrt(h)) : 0;
	for (double k = dof / 2.0 - 1; k >= 0; k--)
		tail += std::exp(-h) * std::pow(h, k) / std::tgamma(k + 1);
	return tail;
}
}  // namespace

double chiSquareQuantile(double p, int dof)
{
	double low = 0, high = 1;
	while (chiSquareTail(high, dof) > 1 - p)
		high *= 2;
	for (int i = 0; i < 60; i++)
		(chiSquareTail((low + high) / 2, dof) > 1 - p ? low : high) = (low + high) / 2;
	return (low + high) / 2;
}
}  // namespace posidonia
