// The short form of scripts/bench consistency: fewer and shorter surveys, so wider bands.
#include <gtest/gtest.h>

#include "consistency.h"

using namespace posidonia;
using namespace posidonia::testing;

TEST(Consistency, TheFilterIsAsAccurateAsItSays)
{
	constexpr int kSeeds = 20;
	constexpr double kDuration = 120;
	TConsistency c;
	for (unsigned seed = 501; seed < 501 + kSeeds; seed++) {
		TSurveyScene scene = surfaceHour(kDuration, seed);
		scene.sensors.gps.at("GPS").bias_time = 20;
		addRun(c, scene, 10);
	}
	for (const auto& [what, anees] : c.anees) {
		if (what == "depth") continue;	// one draw a run: too few to judge by
		EXPECT_EQ(anees.sum.size(), 11U) << what;
		EXPECT_GE(anees.shareInside(), 0.7) << what << "\n" << text(c);
		// The instants of a short run are nearly one for the position: no narrower than the band of one.
		EXPECT_GT(anees.mean(), anees.low()) << what << "\n" << text(c);
		EXPECT_LT(anees.mean(), anees.high()) << what << "\n" << text(c);
	}
	for (const auto& [label, nis] : c.nis) {
		EXPECT_GT(nis.mean(), 0.9) << label << "\n" << text(c);
		EXPECT_LT(nis.mean(), 1.1) << label << "\n" << text(c);
		EXPECT_LT(std::abs(nis.lag1()), 0.1) << label << "\n" << text(c);
	}
	ASSERT_EQ(c.nis.size(), 4U);
}

TEST(Consistency, AFilterThatBoastsIsFoundOut)
{
	// The same, but the DVL is three times as noisy as sensors.ini says.
	TConsistency c;
	for (unsigned seed = 501; seed < 505; seed++) {
		TSurveyScene boast = surfaceHour(120, seed);
		boast.sensors.dvl.at("DVL").sigma_velocity *= 3;
		const TSensorSuite true_sensors = boast.sensors;
		boast.sensors.dvl.at("DVL").sigma_velocity /= 3;
		addRun(c, boast, true_sensors, 20);
	}
	EXPECT_GT(c.nis.at("DVL").mean(), 2) << text(c);
}

TEST(Consistency, DeadReckoningStaysBelowHalfAPercent)
{
	const auto shareOf = [](const std::function<void(TSurveyScene&)>& change) {
		std::vector<double> share;
		for (unsigned seed = 601; seed < 604; seed++) {
			TSurveyScene scene = deadReckoningHour(400, seed);
			change(scene);
			share.push_back(endOf(scene).share());
		}
		std::sort(share.begin(), share.end());
		return share[1];
	};
	const double plain = shareOf([](TSurveyScene&) {});
	const double outliers = shareOf([](TSurveyScene& s) { s.world.dvl.outlier_rate = 0.01; });
	EXPECT_LT(plain, 0.005);
	EXPECT_LT(std::abs(outliers / plain - 1), 0.2);
}

TEST(Consistency, WithoutBottomLockTheDragModelBridgesHonestly)
{
	double worst = 0;
	for (unsigned seed = 701; seed < 706; seed++) {
		TSurveyScene scene = deadReckoningHour(160, seed);
		scene.world.dvl.lock_loss_start = 100;
		scene.world.dvl.lock_loss_duration = 60;
		CEkfOdometry odometry = odometryFor(scene);
		TVehicleState last;
		runSurvey(scene, [&](const mrpt::obs::CObservation::Ptr& o, const TSurveyTruth& truth) {
			odometry.add(*o);
			last = truth.vehicle;
		});
		const TPoseEstimate now = odometry.now();
		const Eigen::Vector3d e = localCoordinates(now.T, last.T_map_body).head<3>();
		worst = std::max(worst, e.dot(now.cov.topLeftCorner<3, 3>().ldlt().solve(e)));
		EXPECT_LT(e.norm(), 10) << "seed=" << seed;
		EXPECT_NEAR(odometry.statistics().drag_time, 59, 2) << "seed=" << seed;
		EXPECT_GT(std::sqrt(now.cov(0, 0)), 0.5) << "seed=" << seed;
	}
	EXPECT_LT(worst, 16.3);	 // chi-square, 3 degrees of freedom, 99.9 %
}
