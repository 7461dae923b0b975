// The engine on a simulated survey: what it keeps, where its nodes are, and how good they are.
#include <gtest/gtest.h>

#include "survey.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;

TEST(Engine, keepsTheOptimisedPoses)
{
	const CStereoSlam& slam = defaultRun();
	ASSERT_GT(edgesOf(slam, EEdgeKind::ROI), 0);
	// MRPT's own step would have left the poses that Dijkstra composes (MRPT/mrpt#985).
	EXPECT_LT(slam.chi2(), 0.1 * slam.dijkstraChi2());
	RecordProperty("chi2", std::to_string(slam.chi2()));
	RecordProperty("chi2_dijkstra", std::to_string(slam.dijkstraChi2()));
}

TEST(Engine, handsOutTheOptimisedPoseOfTheNode)
{
	TSetup setup = secondExperiment();
	setup.stop_at_nodes = 10;  // stops right after the tenth node and its optimisation
	const auto slam = run(setup);
	ASSERT_TRUE(slam->addedNode());
	const Isometry3d T_map_body = slam->map().pose(slam->map().lastNode());
	EXPECT_LT(localCoordinates(T_map_body, slam->now().T_map_body).norm(), 1e-9);
	EXPECT_LT(localCoordinates(T_map_body, slam->causal().back().T_map_body).norm(), 1e-9);
	// And it is not what the odometry alone says.
	EXPECT_GT((T_map_body.translation() - slam->now().T_odom_body.translation()).norm(), 1e-3);
}

TEST(Engine, causalPosesAreNeverRewritten)
{
	TSetup setup = secondExperiment();
	setup.stop_at_nodes = 10;
	const auto early = run(setup);
	const auto& late = defaultRun().causal();
	ASSERT_GE(late.size(), early->causal().size());
	for (size_t k = 0; k < early->causal().size(); k++)
		EXPECT_EQ(early->causal()[k].T_map_body.matrix(), late[k].T_map_body.matrix()) << "pair " << k;
	EXPECT_EQ(late.size(), survey().pair_stamps.size());
}

TEST(Engine, firstNodeIsTheFirstPairAtTheOdometrysPose)
{
	const CStereoSlam& slam = defaultRun();
	const TSlamNode& root = slam.map().node(0);
	EXPECT_EQ(root.stamp, survey().pair_stamps.front());
	// Its prior, with the filter's covariance there, lets the graph move it a little.
	EXPECT_LT(localCoordinates(root.T_odom_body, slam.map().pose(0)).norm(), 0.05);
	EXPECT_LT((slam.map().pose(0).translation() - Eigen::Vector3d(-1.5, -1.5, 3.5)).norm(), 0.02);
	ASSERT_NE(root.key_frame, nullptr);
	EXPECT_GT(root.key_frame->size(), 50u);
}

TEST(Engine, mapAndOdometryAreOneBeforeTheFirstNode)
{
	const TSurvey& s = survey();
	CStereoSlam slam({}, s.sensors, s.ekf(), std::make_unique<CStereoImageLoader>(s.rawlog));
	slam.add(s.observations.front());
	ASSERT_EQ(slam.map().nodeCount(), 0);
	ASSERT_TRUE(slam.odometry().ready());
	EXPECT_EQ(slam.now().T_map_body.matrix(), slam.odometry().now().T.matrix());
}

TEST(Engine, nodesAreHalfAMetreApart)
{
	const CStereoSlam& slam = defaultRun();
	// Longest way between pairs: 0.3 m/s at 4 Hz, and what the small motion and the odometry's noise add.
	const double half_step = 0.5 * (0.3 / 4) + 0.015;
	double sum = 0;
	for (const auto& edge : slam.map().edges()) {
		if (edge.kind != EEdgeKind::ODOMETRY) continue;
		const double distance = edge.T_from_to.translation().norm();
		EXPECT_NEAR(distance, 0.5, half_step) << "edge " << edge.from << " to " << edge.to;
		// The filter's velocity lags by half a DVL period while the vehicle speeds up: 0.3 m/s times 0.1 s.
		EXPECT_GT(edge.path_length, distance - 0.05) << "edge " << edge.from << " to " << edge.to;
		sum += distance;
	}
	const int odometry_edges = edgesOf(slam, EEdgeKind::ODOMETRY);
	EXPECT_EQ(odometry_edges, slam.map().nodeCount() - 1);
	EXPECT_NEAR(sum / odometry_edges, 0.5, 0.01);
	EXPECT_NEAR(
		slam.map().nodeCount(), 15.6 / 0.5 + 1, 3);	 // corners are cut: a node a bit later than the way says
}

TEST(Engine, corruptedOdometryIsCorrected)
{
	const CStereoSlam& slam = defaultRun();
	const double odometry = meanOdometryError(slam), nodes = meanNodeError(slam);
	EXPECT_GT(odometry, 0.08);
	EXPECT_LT(nodes, odometry / 5);
	EXPECT_LT(nodes, 0.03);
	std::printf(
		"[   INFO   ] mean error: odometry %.4f m, SLAM %.4f m; chi2 %.1f, Dijkstra %.3g\n", odometry, nodes,
		slam.chi2(), slam.dijkstraChi2());
}

TEST(Engine, whatIsLeftIsTheRootsHeading)
{
	// Seen from the root, the nodes are better still: the root keeps the heading error that the filter had
	// there.
	const CStereoSlam& slam = defaultRun();
	double sum = 0;
	for (int i = 0; i < slam.map().nodeCount(); i++)
		sum += errorOfPair(slam, 0, i, slam.map().relativePose(0, i)).metres;
	const double from_root = sum / slam.map().nodeCount();
	std::printf("[   INFO   ] mean error seen from the root: %.4f m\n", from_root);
	EXPECT_LT(from_root, 0.012);
}

TEST(Engine, informationOfTheEdgesIsNearTheTruth)
{
	// Stereo edges of these small pictures are measured at 9 to 11: their sigmas are a quarter too small.
	const CStereoSlam& slam = defaultRun();
	for (const auto kind : {EEdgeKind::ODOMETRY, EEdgeKind::SEQUENTIAL, EEdgeKind::ROI}) {
		double sum = 0;
		for (const auto& edge : slam.map().edges()) {
			if (edge.kind != kind) continue;
			const auto T_from = survey().truth(slam.map().node(edge.from).stamp);
			const auto T_to = survey().truth(slam.map().node(edge.to).stamp);
			const Vector6d d = localCoordinates(T_from.inverse() * T_to, edge.T_from_to);
			sum += d.dot(edge.information * d);
		}
		const double nees = sum / edgesOf(slam, kind);
		std::printf("[   INFO   ] NEES of the %s edges: %.2f (6 when honest)\n", toString(kind), nees);
		EXPECT_GT(nees, 1) << toString(kind);
		EXPECT_LT(nees, 18) << toString(kind);
	}
}

TEST(Engine, noFalseEdge)
{
	const CStereoSlam& slam = defaultRun();
	double worst_metres = 0, worst_radians = 0;
	for (const auto& edge : slam.map().edges()) {
		const TPairError error = errorOfPair(slam, edge.from, edge.to, edge.T_from_to);
		EXPECT_FALSE(error.isFalse()) << toString(edge.kind) << " edge " << edge.from << " to " << edge.to
									  << ": " << error.metres << " m, " << error.radians << " rad";
		if (edge.kind == EEdgeKind::ODOMETRY) continue;
		worst_metres = std::max(worst_metres, error.metres);
		worst_radians = std::max(worst_radians, error.radians);
	}
	std::printf(
		"[   INFO   ] %d nodes, %d sequential and %d ROI edges, the worst %.3f m, %.4f rad\n",
		slam.map().nodeCount(), edgesOf(slam, EEdgeKind::SEQUENTIAL), edgesOf(slam, EEdgeKind::ROI),
		worst_metres, worst_radians);
}

TEST(Engine, sameBytesAgainAndOnOneThread)
{
	const std::string bytes = fingerprint(defaultRun());
	TSetup setup = secondExperiment();
	EXPECT_TRUE(fingerprint(*run(setup)) == bytes)
		<< "a second run on " << setup.slam.slam.threads << " threads differs";
	setup.slam.slam.threads = 1;
	EXPECT_TRUE(fingerprint(*run(setup)) == bytes) << "one thread differs";
}
