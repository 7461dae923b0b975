#include <gtest/gtest.h>
#include <posidonia/report/axis_ticks.h>

#include <cmath>
#include <random>

using namespace posidonia;

TEST(AxisTicks, OfRangesWorkedOutByHand)
{
	EXPECT_EQ(roundTicks(-5.2, 5.2, 5).values, (std::vector<double>{-4, -2, 0, 2, 4}));
	EXPECT_EQ(roundTicks(0, 100, 5).values, (std::vector<double>{0, 20, 40, 60, 80, 100}));
	const TTicks small = roundTicks(0, 0.3, 3);
	EXPECT_EQ(small.values.size(), 4u);
	EXPECT_EQ(small.label(small.values[3]), "0.3");
	EXPECT_EQ(roundTicks(0, 0.041, 5).label(0.02), "0.02");
	EXPECT_EQ(roundTicks(0, 4100, 5).label(2000), "2000");
	EXPECT_EQ(roundTicks(-1, 1, 5).label(-1e-17), "0.0");
}

TEST(AxisTicks, AreRoundInsideAndNotTooMany)
{
	std::mt19937 rng(1);
	std::uniform_real_distribution<double> u(-1, 1);
	for (int i = 0; i < 200; i++) {
		const double min = 100 * u(rng), max = min + std::pow(10.0, 3 * u(rng));
		const TTicks ticks = roundTicks(min, max, 6);
		EXPECT_GE(ticks.values.size(), 2u) << "i=" << i;
		EXPECT_LE(ticks.values.size(), 12u) << "i=" << i;
		for (double v : ticks.values) {
			EXPECT_GE(v, min - 1e-6 * ticks.step) << "i=" << i;
			EXPECT_LE(v, max + 1e-6 * ticks.step) << "i=" << i;
			EXPECT_NEAR(std::stod(ticks.label(v)), v, 1e-6 * ticks.step)
				<< "i=" << i << ": the label says the value";
		}
	}
}
