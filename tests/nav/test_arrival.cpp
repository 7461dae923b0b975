// Readings that come late, twice, or with stamps that can't be.
#include <gtest/gtest.h>
#include <posidonia/obs/observations.h>

#include <algorithm>
#include <cstring>

#include <allocation_counter.h>
#include "nav_simulator.h"
#include "simulated_survey.h"

using namespace posidonia;
using namespace posidonia::testing;
using mrpt::obs::CObservation;

namespace
{
using TLog = std::vector<CObservation::Ptr>;

TLog logOf(const TSurveyScene& scene)
{
	TLog log;
	runSurvey(scene, [&](const CObservation::Ptr& o, const TSurveyTruth&) { log.push_back(o); });
	return log;
}

/** The log as it arrives when a share of all but the IMU's readings is late by up to `delay` [s]. */
TLog delayed(const TLog& log, double share, double delay, unsigned seed)
{
	std::mt19937 rng(seed);
	std::uniform_real_distribution<double> uniform;
	std::vector<std::pair<double, CObservation::Ptr>> arrivals;
	for (const auto& o : log) {
		const bool late = o->sensorLabel != "IMU" && uniform(rng) < share;
		arrivals.push_back({stampOf(*o) + (late ? delay * uniform(rng) : 0), o});
	}
	std::stable_sort(
		arrivals.begin(), arrivals.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
	TLog arrived;
	for (const auto& [t, o] : arrivals)
		arrived.push_back(o);
	return arrived;
}

/** Feeds the log; a clone each `node_every` IMU readings (0: none). */
void feed(CEkfOdometry& odometry, const TLog& log, int node_every = 0)
{
	int readings = 0;
	for (const auto& o : log) {
		odometry.add(*o);
		if (node_every && odometry.ready() && o->sensorLabel == "IMU" && ++readings % node_every == 0)
			odometry.clone();
	}
}

double difference(const CEkfOdometry& a, const CEkfOdometry& b)
{
	return std::max(
		localCoordinates(a.navigationFilter().state(), b.navigationFilter().state()).norm(),
		(a.navigationFilter().covariance() - b.navigationFilter().covariance()).norm());
}
}  // namespace

TEST(Arrival, LateMessagesEndWhereThoseInOrderDo)
{
	const TSurveyScene scene = surfaceHour(120, 3);
	const TLog log = logOf(scene);
	CEkfOdometry in_order = odometryFor(scene), late = odometryFor(scene);
	feed(in_order, log);
	feed(late, delayed(log, 0.05, 2.0, 1));
	size_t replayed = 0;
	for (const auto& [label, count] : late.statistics().sensors)
		replayed += count.replayed;
	EXPECT_GT(replayed, 80U);
	EXPECT_EQ(late.statistics().replays, replayed);
	EXPECT_LT(difference(in_order, late), 1e-9);
	for (const auto& [label, count] : in_order.statistics().sensors)
		EXPECT_EQ(late.statistics().sensors.at(label).used, count.used) << label;
}

TEST(Arrival, TheCloneIsReplayedToo)
{
	const TSurveyScene scene = deadReckoningHour(30, 4);
	const TLog log = logOf(scene);
	CEkfOdometry in_order = odometryFor(scene), late = odometryFor(scene);
	feed(in_order, log, 150);
	feed(late, delayed(log, 0.3, 1.0, 2), 150);
	EXPECT_LT(difference(in_order, late), 1e-9);
	EXPECT_LT((in_order.sinceClone().T.matrix() - late.sinceClone().T.matrix()).norm(), 1e-9);
	EXPECT_LT((in_order.sinceClone().cov - late.sinceClone().cov).norm(), 1e-9);
}

namespace
{
/** Each 5 s, just after the other sensors have read [s]. */
double nodeTime(size_t nodes_before)
{
	return 5.005 + 5 * static_cast<double>(nodes_before);
}
}  // namespace

TEST(Arrival, EdgesAreRevisedUntilTheyAreFinal)
{
	const TSurveyScene scene = deadReckoningHour(20, 5);
	const TLog log = logOf(scene);
	CEkfOdometry in_order = odometryFor(scene);
	std::vector<TPoseEstimate> right;
	for (const auto& o : log) {
		in_order.add(*o);
		if (o->sensorLabel != "IMU" || stampOf(*o) < nodeTime(right.size()) + scene.world.run.start_time)
			continue;
		right.push_back(in_order.sinceClone());
		in_order.clone();
	}
	ASSERT_EQ(right.size(), 3U);
	// One ping before the second node comes 0.4 s late: its edge is revised. One before the third comes 3 s
	// late: its edge is final, the filter learns of it all the same.
	CEkfOdometry late = odometryFor(scene);
	const double start = scene.world.run.start_time;
	CObservation::Ptr soon, last;
	std::vector<TPoseEstimate> told;
	std::vector<TRevisedEdge> revised;
	for (const auto& o : log) {
		const double t = stampOf(*o) - start;
		if (o->sensorLabel == "DVL" && t > 9.7 && t < 9.85)
			soon = o;
		else if (o->sensorLabel == "DVL" && t > 14.7 && t < 14.85)
			last = o;
		else
			late.add(*o);
		if (soon && t > 10.2) late.add(*std::exchange(soon, nullptr));
		if (last && t > 17.8) late.add(*std::exchange(last, nullptr));
		if (o->sensorLabel == "IMU" && t >= nodeTime(told.size())) {
			told.push_back(late.sinceClone());
			late.clone();
		}
		for (const auto& r : late.takeRevisedEdges())
			revised.push_back(r);
	}
	ASSERT_EQ(revised.size(), 1U);
	EXPECT_EQ(revised[0].clone, 1U);
	EXPECT_GT((told[1].T.matrix() - right[1].T.matrix()).norm(), 1e-9);
	EXPECT_LT((revised[0].edge.T.matrix() - right[1].T.matrix()).norm(), 1e-9);
	EXPECT_LT((revised[0].edge.cov - right[1].cov).norm(), 1e-9);
	EXPECT_EQ(late.statistics().edges_revised, 1U);
	EXPECT_EQ(late.statistics().edges_kept, 1U);
	EXPECT_LT(difference(in_order, late), 1e-9);
	EXPECT_NE(late.statistics().text().find("1 edges revised, 1 final edges kept"), std::string::npos)
		<< late.statistics().text();
}

TEST(Arrival, WhatIsOlderThanTheHistoryIsDroppedAndCounted)
{
	TSurveyScene scene = deadReckoningHour(30, 6);
	scene.ekf.history = 3;
	const TLog log = logOf(scene);
	CEkfOdometry odometry = odometryFor(scene), without = odometryFor(scene);
	CObservation::Ptr old;
	for (const auto& o : log) {
		if (!old && o->sensorLabel == "DVL" && stampOf(*o) > scene.world.run.start_time + 10) {
			old = o;
			continue;
		}
		odometry.add(*o);
		without.add(*o);
	}
	odometry.add(*old);
	EXPECT_EQ(odometry.statistics().sensors.at("DVL").late, 1U);
	EXPECT_EQ(difference(odometry, without), 0);
}

TEST(Arrival, OneStampFromTheFutureDoesNotMoveTheFilter)
{
	const TSurveyScene scene = deadReckoningHour(20, 7);
	CEkfOdometry odometry = odometryFor(scene), clean = odometryFor(scene);
	int readings = 0;
	for (const auto& o : logOf(scene)) {
		clean.add(*o);
		odometry.add(*o);
		if (o->sensorLabel != "PRESSURE" || ++readings != 40) continue;
		auto wrong = std::make_shared<CObservationPressure>(dynamic_cast<const CObservationPressure&>(*o));
		wrong->timestamp = stampFrom(stampOf(*o) + 3600);
		odometry.add(*wrong);
	}
	EXPECT_EQ(odometry.statistics().sensors.at("PRESSURE").jumped, 1U);
	EXPECT_EQ(difference(odometry, clean), 0);
}

TEST(Arrival, AGapInTheLogIsWalkedOverWithAGrowingCovariance)
{
	const TSurveyScene scene = deadReckoningHour(60, 8);
	CEkfOdometry odometry = odometryFor(scene);
	double sigma_before = 0, worst_share = 0;
	runSurvey(scene, [&](const CObservation::Ptr& o, const TSurveyTruth& truth) {
		const double t = truth.vehicle.t;
		if (t > 30 && t < 40) return;
		odometry.add(*o);
		const TPoseEstimate now = odometry.now();
		if (t < 30) sigma_before = std::sqrt(now.cov(0, 0));
		const Vector6d e = localCoordinates(now.T, truth.vehicle.T_map_body);
		if (t > 41)
			worst_share = std::max(
				worst_share,
				std::max(
					std::abs(e[0]) / std::sqrt(now.cov(0, 0)), std::abs(e[1]) / std::sqrt(now.cov(1, 1))));
	});
	EXPECT_GT(std::sqrt(odometry.now().cov(0, 0)), 3 * sigma_before);
	EXPECT_LT(worst_share, 4);
	EXPECT_GT(odometry.statistics().sensors.at("IMU").jumped, 0U);
	EXPECT_EQ(odometry.statistics().sensors.at("DVL").outages, 1U);
}

TEST(Arrival, AClockThatIsSetBackIsFollowed)
{
	const TSurveyScene scene = deadReckoningHour(40, 9);
	CEkfOdometry odometry = odometryFor(scene);
	TVehicleState last;
	runSurvey(scene, [&](const CObservation::Ptr& o, const TSurveyTruth& truth) {
		last = truth.vehicle;
		if (truth.vehicle.t > 20) o->timestamp = stampFrom(stampOf(*o) - 3600);
		odometry.add(*o);
	});
	EXPECT_EQ(odometry.statistics().clock_resets, 1U);
	EXPECT_NEAR(odometry.stamp(), scene.world.run.start_time + 40 - 3600, 0.1);
	EXPECT_LT((odometry.now().T.translation() - last.T_map_body.translation()).norm(), 0.3);
}

TEST(Arrival, NothingIsAllocatedOnceTheHistoryIsFull)
{
	const TSurveyScene scene = surfaceHour(60, 10);
	const TLog log = logOf(scene);
	CEkfOdometry odometry = odometryFor(scene);
	const size_t half = log.size() / 2;
	for (size_t i = 0; i < half; i++)
		odometry.add(*log[i]);
	const size_t before = allocations();
	for (size_t i = half; i < log.size(); i++)
		odometry.add(*log[i]);
	EXPECT_EQ(allocations() - before, 0U);
}

TEST(Arrival, PicturesThatComeLateMakeTheSameEdges)
{
	// Each stereo pair comes 0.13 s after its stamp, when later readings have been fused.
	TNavScene scene;
	scene.duration = 20;
	const auto edgesWith = [&](double delay) {
		CEkfOdometry odometry({}, knownStart(scene.start), scene.sensors, scene.datum);
		std::vector<TPoseEstimate> edges;
		std::vector<CObservation::Ptr> waiting;
		const auto node = [&](const CObservation& pair) {
			odometry.add(pair);
			EXPECT_EQ(odometry.stamp(), stampOf(pair));
			edges.push_back(odometry.sinceClone());
			odometry.clone();
			EXPECT_LT(odometry.sinceClone().cov.norm(), 1e-14);
		};
		CNavSimulator(scene).run([&](const CObservation& o, const TNavTruth&) {
			while (!waiting.empty() && stampOf(o) > stampOf(*waiting.front()) + delay) {
				node(*waiting.front());
				waiting.erase(waiting.begin());
			}
			if (o.sensorLabel == "STEREO")
				waiting.push_back(std::dynamic_pointer_cast<CObservation>(o.duplicateGetSmartPtr()));
			else
				odometry.add(o);
		});
		EXPECT_EQ(odometry.takeRevisedEdges().size(), 0U);
		return edges;
	};
	const auto at_once = edgesWith(0), late = edgesWith(0.13);
	ASSERT_GT(late.size(), 45U);
	for (size_t i = 0; i < late.size(); i++) {
		EXPECT_LT((late[i].T.matrix() - at_once[i].T.matrix()).norm(), 1e-12) << "edge " << i;
		EXPECT_LT((late[i].cov - at_once[i].cov).norm(), 1e-15) << "edge " << i;
	}
}
