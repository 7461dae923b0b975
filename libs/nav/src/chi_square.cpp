#include <posidonia/nav/chi_square.h>

#include <cmath>

namespace posidonia
{
namespace
{
double chiSquareCdf(double x, int dof)
{
	const double one = std::erf(std::sqrt(x / 2));
	switch (dof) {
		case 1:
			return one;
		case 2:
			return 1 - std::exp(-x / 2);
		case 3:
			return one - std::sqrt(2 * x / M_PI) * std::exp(-x / 2);
		default:
			return 1 - (1 + x / 2) * std::exp(-x / 2);
	}
}
}  // namespace

double chiSquareQuantile(double p, int dof)
{
	double low = 0, high = 100;
	for (int i = 0; i < 60; i++)
		(chiSquareCdf((low + high) / 2, dof) < p ? low : high) = (low + high) / 2;
	return (low + high) / 2;
}
}  // namespace posidonia
