#include <gtest/gtest.h>
#include <posidonia/base/chi_square.h>

#include <cmath>

using namespace posidonia;

namespace
{
struct TEntry
{
	int dof;
	double p, x;
};
}  // namespace

/** Abramowitz, Stegun, table 26.8. */
TEST(ChiSquare, QuantilesAreTheTables)
{
	for (const auto& [dof, p, x] :
		 {TEntry{1, 0.95, 3.84146},
		  {1, 0.999, 10.828},
		  {2, 0.5, 1.38629},
		  {2, 0.99, 9.21034},
		  {3, 0.95, 7.81473},
		  {4, 0.99, 13.2767},
		  {5, 0.5, 4.35146},
		  {6, 0.5, 5.34812},
		  {6, 0.95, 12.5916},
		  {6, 0.999, 22.458},
		  {10, 0.95, 18.3070},
		  {30, 0.99, 50.8922}})
		EXPECT_NEAR(chiSquareQuantile(p, dof), x, 1e-4 * x) << dof << " degrees of freedom, p = " << p;
}

/** The square of a normal variable: p = erf(sqrt(x / 2)). */
TEST(ChiSquare, OneDegreeOfFreedomIsASquaredNormal)
{
	for (const double sigmas : {0.1, 1.0, 3.0, 5.0})
		EXPECT_NEAR(
			chiSquareQuantile(std::erf(sigmas / std::sqrt(2)), 1), sigmas * sigmas, 1e-7 * sigmas * sigmas)
			<< sigmas << " sigma";
}
