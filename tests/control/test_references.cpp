#include <gtest/gtest.h>
#include <posidonia/control/references.h>

#include <cmath>

using namespace posidonia;

TEST(TurnProfile, DerivativesAreThoseOfTheHeading)
{
	const CTurnProfile turn(0.4, -1.6, 0.35, 0.12);
	const double h = 1e-4;
	for (double t = 0.05; t < turn.duration(); t += 0.37) {
		const double rate = (turn.at(t + h).value - turn.at(t - h).value) / (2 * h);
		const double acceleration = (turn.at(t + h).rate - turn.at(t - h).rate) / (2 * h);
		EXPECT_NEAR(turn.at(t).rate, rate, 1e-6) << "t=" << t;
		EXPECT_NEAR(turn.at(t).acceleration, acceleration, 1e-6) << "t=" << t;
	}
	EXPECT_EQ(turn.at(0).value, 0.4);
	EXPECT_DOUBLE_EQ(turn.at(100).value, -1.2);
	EXPECT_EQ(turn.at(100).rate, 0);
}

TEST(TurnProfile, ReachesOneOfItsPeaksAndPassesNone)
{
	for (double angle : {0.02, 0.3, 1.57, 3.1, -2.0}) {
		const CTurnProfile turn(0, angle, 0.35, 0.12);
		double rate = 0, acceleration = 0;
		for (double t = 0; t < turn.duration(); t += turn.duration() / 2000) {
			rate = std::max(rate, std::abs(turn.at(t).rate));
			acceleration = std::max(acceleration, std::abs(turn.at(t).acceleration));
		}
		EXPECT_LE(rate, 0.35 * 1.0001) << "angle=" << angle;
		EXPECT_LE(acceleration, 0.12 * 1.0001) << "angle=" << angle;
		EXPECT_GT(std::max(rate / 0.35, acceleration / 0.12), 0.999) << "angle=" << angle;
	}
}

TEST(TurnProfile, NoTurnIsNoTurn)
{
	const CTurnProfile turn(0.7, 0, 0.35, 0.12);
	EXPECT_EQ(turn.duration(), 0);
	EXPECT_EQ(turn.at(0).value, 0.7);
	EXPECT_EQ(turn.at(1).value, 0.7);
}

TEST(SmoothReference, KeepsItsBoundsAndDoesNotOvershoot)
{
	for (double target : {3.5, -2.0, 0.01, 0.3}) {
		CSmoothReference reference;
		reference.reset(0);
		double furthest = 0, before = 0;
		for (int i = 0; i < 600; i++) {
			const TReference now = reference.update(target, 0.2, 0.05, 0.1);
			EXPECT_LE(std::abs(now.rate), 0.2 + 1e-12) << "target=" << target;
			EXPECT_LE(std::abs(now.acceleration), 0.05 + 1e-9) << "target=" << target << " step " << i;
			EXPECT_NEAR(now.value - before, now.rate * 0.1, 1e-12);
			before = now.value;
			furthest = std::max(furthest, now.value / target);
		}
		EXPECT_LE(furthest, 1 + 1e-9) << "target=" << target;
		EXPECT_NEAR(reference.now().value, target, 1e-3) << "target=" << target;
	}
}
