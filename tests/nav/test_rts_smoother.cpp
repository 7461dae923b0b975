// The way back over a log.
#include <gtest/gtest.h>
#include <posidonia/nav/rts_smoother.h>
#include <posidonia/obs/observations.h>

#include "simulated_survey.h"

using namespace posidonia;
using namespace posidonia::testing;
using mrpt::obs::CObservation;

namespace
{
std::shared_ptr<const TNavigatorSetup> setupOf(const TSurveyScene& s)
{
	return std::make_shared<const TNavigatorSetup>(s.ekf, s.drag, s.start, s.sensors, s.world.world);
}

struct TOutcome
{
	double filter{0}, smoothed{0};	///< Root mean square of the position's error [m]
	double nees{0};					///< Of the smoothed pose, per degree of freedom
	double end_difference{0};		///< Smoothed and filter at the end [m]
};

/** Dives with fixes at both ends only: the filter learns at the end where it was. */
TOutcome smoothSurvey(unsigned seed)
{
	TSurveyScene scene = surfaceHour(180, seed);
	CEkfOdometry odometry = odometryFor(scene);
	std::vector<TSensorReading> readings;
	odometry.keepReadings(readings);
	std::map<double, std::pair<Eigen::Isometry3d, Eigen::Isometry3d>> truth_and_filter;
	runSurvey(scene, [&](const CObservation::Ptr& o, const TSurveyTruth& truth) {
		const double t = truth.vehicle.t;
		if (o->sensorLabel == "GPS" && t > 40 && t < 160) return;
		odometry.add(*o);
		if (odometry.ready()) truth_and_filter[stampOf(*o)] = {truth.vehicle.T_map_body, odometry.now().T};
	});
	TOutcome outcome;
	const auto poses = CRtsSmoother(setupOf(scene)).smooth(readings, 1);
	const auto n = static_cast<double>(poses.size());
	for (const auto& p : poses) {
		const auto& [truth, filter] = truth_and_filter.at(p.stamp);
		outcome.filter += (filter.translation() - truth.translation()).squaredNorm() / n;
		outcome.smoothed += (p.pose.T.translation() - truth.translation()).squaredNorm() / n;
		const Vector6d e = localCoordinates(p.pose.T, truth);
		outcome.nees += e.dot(p.pose.cov.ldlt().solve(e)) / 6 / n;
	}
	EXPECT_GT(poses.size(), 165U);
	outcome.end_difference = (poses.back().pose.T.translation() - odometry.now().T.translation()).norm();
	outcome.filter = std::sqrt(outcome.filter);
	outcome.smoothed = std::sqrt(outcome.smoothed);
	return outcome;
}
}  // namespace

TEST(RtsSmoother, KnowsBetterThanTheFilterAndSaysHowWell)
{
	double filter = 0, smoothed = 0, nees = 0;
	constexpr int kSeeds = 8;
	for (unsigned seed = 1; seed <= kSeeds; seed++) {
		const TOutcome o = smoothSurvey(seed);
		filter += o.filter / kSeeds;
		smoothed += o.smoothed / kSeeds;
		nees += o.nees / kSeeds;
		EXPECT_LT(o.end_difference, 1e-6) << "seed=" << seed;
	}
	EXPECT_LT(smoothed, 0.95 * filter);
	EXPECT_GT(nees, 0.6) << "filter " << filter << " m, smoothed " << smoothed << " m";
	EXPECT_LT(nees, 1.5);
	RecordProperty("filter_mm", static_cast<int>(1e3 * filter));
	RecordProperty("smoothed_mm", static_cast<int>(1e3 * smoothed));
}

TEST(RtsSmoother, TheOrderOfArrivalDoesNotMatter)
{
	const TSurveyScene scene = deadReckoningHour(15, 3);
	std::vector<TSensorReading> readings;
	CEkfOdometry odometry = odometryFor(scene);
	odometry.keepReadings(readings);
	runSurvey(scene, [&](const CObservation::Ptr& o, const TSurveyTruth&) { odometry.add(*o); });
	const auto a = CRtsSmoother(setupOf(scene)).smooth(readings, 1);
	std::reverse(readings.begin(), readings.end());
	const auto b = CRtsSmoother(setupOf(scene)).smooth(readings, 1);
	ASSERT_EQ(a.size(), b.size());
	ASSERT_GE(a.size(), 14U);
	for (size_t i = 0; i < a.size(); i++)
		EXPECT_EQ((a[i].pose.T.matrix() - b[i].pose.T.matrix()).norm(), 0) << "i=" << i;
}

TEST(RtsSmoother, ALogWithoutAStartHasNoPoses)
{
	const TSurveyScene scene = surfaceHour(5, 3);  // not ten fixes
	std::vector<TSensorReading> readings;
	CEkfOdometry odometry = odometryFor(scene);
	odometry.keepReadings(readings);
	runSurvey(scene, [&](const CObservation::Ptr& o, const TSurveyTruth&) { odometry.add(*o); });
	EXPECT_GT(readings.size(), 500U);
	EXPECT_TRUE(CRtsSmoother(setupOf(scene)).smooth(readings, 1).empty());
}
