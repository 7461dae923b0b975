// What edges that are made of the same points may claim: by hand, by law, and in the map.
#include <gtest/gtest.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/graphslam/CSparseGSO.h>
#include <posidonia/graphslam/shared_points.h>

#include <random_pose.h>

#include "survey.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;

namespace
{
/** Points 0 .. n-1 of one frame matched to the same of another. */
CSharedPoints::TPoints same(int n, int first = 0)
{
	CSharedPoints::TPoints points;
	for (int k = first; k < first + n; k++)
		points.emplace_back(k, k);
	return points;
}

/** Every pair of n frames that all see the same points. */
CSharedPoints clique(int n)
{
	CSharedPoints shared;
	for (int j = 1; j < n; j++)
		for (int i = 0; i < j; i++)
			shared.addEdge(i, j, same(20));
	return shared;
}
}  // namespace

TEST(SharedPoints, aSingleEdgeClaimsAll)
{
	CSharedPoints shared;
	shared.addEdge(0, 1, same(5));
	shared.addEdge(2, 3, {});
	EXPECT_EQ(shared.share(0), 1);
	EXPECT_EQ(shared.share(1), 1) << "an edge without points";
}

TEST(SharedPoints, eachEdgeOfACliqueClaimsTwoOverN)
{
	for (int n = 2; n < 12; n++) {
		const CSharedPoints shared = clique(n);
		for (int e = 0; e < shared.edgeCount(); e++)
			EXPECT_NEAR(shared.share(e), 2.0 / n, 1e-12) << n << " frames, edge " << e;
	}
}

TEST(SharedPoints, aChainOrTreeClaimsAll)
{
	// n frames joined by n - 1 edges: each difference is measured once.
	CSharedPoints shared;
	for (int j = 1; j < 8; j++)
		shared.addEdge((j - 1) / 2, j, same(10));
	for (int e = 0; e < shared.edgeCount(); e++)
		EXPECT_EQ(shared.share(e), 1) << "edge " << e;
}

TEST(SharedPoints, theMeanOverItsPoints)
{
	// Ten points seen by three frames and each pair of them, ten more by the first two only.
	CSharedPoints shared;
	shared.addEdge(0, 1, same(20));
	shared.addEdge(0, 2, same(10));
	shared.addEdge(1, 2, same(10));
	EXPECT_NEAR(shared.share(0), 0.5 * (2.0 / 3 + 1), 1e-12);
	EXPECT_NEAR(shared.share(1), 2.0 / 3, 1e-12);
}

TEST(SharedPoints, allEdgesOfASpotClaimItsDifferences)
{
	// Law: over edges of one point each the shares of a spot sum up to its frames less one, in any order.
	std::mt19937 rng(1);
	for (int n = 0; n < 30; n++) {
		constexpr int kFrames = 9;
		std::vector<std::pair<int, int>> pairs;
		for (int j = 1; j < kFrames; j++)
			for (int i = 0; i < j; i++)
				if (i == j - 1 || rng() % 3 == 0) pairs.emplace_back(i, j);	 // connected
		std::shuffle(pairs.begin(), pairs.end(), rng);
		CSharedPoints shared;
		for (const auto& [i, j] : pairs)
			shared.addEdge(i, j, {{7, 7}});
		double sum = 0;
		for (int e = 0; e < shared.edgeCount(); e++)
			sum += shared.share(e);
		EXPECT_NEAR(sum, kFrames - 1, 1e-9) << "case " << n;
	}
}

TEST(SharedPoints, aCliqueHoldsWhatItsPointsHold)
{
	// The least-squares positions of n frames on a line, each with its own error of a spot: by the spot
	// itself, and by shared edges between all pairs. Without shares it would be n / 2 times too sure.
	for (int n = 2; n < 9; n++) {
		const CSharedPoints shared = clique(n);
		// Laplacian of the edges, each of variance 2 sigma^2 (sigma = 1), frame 0 fixed.
		Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
		int e = 0;
		for (int j = 1; j < n; j++)
			for (int i = 0; i < j; i++, e++) {
				const double w = shared.share(e) / 2;
				L(i, i) += w, L(j, j) += w, L(i, j) -= w, L(j, i) -= w;
			}
		const Eigen::MatrixXd C = L.bottomRightCorner(n - 1, n - 1).inverse();
		// The frames' positions against the spot have independent errors of sigma 1: their differences.
		const Eigen::MatrixXd expected =
			Eigen::MatrixXd::Identity(n - 1, n - 1) + Eigen::MatrixXd::Ones(n - 1, n - 1);
		EXPECT_LT((C - expected).norm(), 1e-9) << n << " frames";
	}
}

TEST(SharedPoints, tellsWhoseShareMayHaveChanged)
{
	CSharedPoints shared;
	shared.addEdge(0, 1, same(5));
	shared.addEdge(2, 3, same(5));
	EXPECT_EQ(shared.takeTouched(), (std::vector<int>{0, 1}));
	EXPECT_TRUE(shared.takeTouched().empty());
	shared.addEdge(1, 4, same(2));
	EXPECT_EQ(shared.takeTouched(), (std::vector<int>{0, 2}));
	shared.addEdge(4, 5, same(3, 10));	// other points of frame 4
	EXPECT_EQ(shared.takeTouched(), (std::vector<int>{3}));
	shared.addEdge(3, 4, same(5));	// joins both families
	EXPECT_EQ(shared.takeTouched(), (std::vector<int>{0, 1, 2, 4}));
}

namespace
{
struct TBoundMap
{
	TSlamGraph graph;
	CSlamMap map;
	TBoundMap(int nodes)
	{
		map.bind(graph);
		for (int k = 0; k < nodes; k++)
			map.addNode({}, Isometry3d::Identity());
	}
	void stereo(int from, int to)
	{
		map.addEdge(
			{from, to, EEdgeKind::ROI, Isometry3d::Identity(), 4 * Matrix6d::Identity(), 0, same(10)});
	}
};
}  // namespace

TEST(SlamMapShares, revisedInBothGraphs)
{
	TBoundMap m(3);
	m.map.addEdge({0, 1, EEdgeKind::ODOMETRY, Isometry3d::Identity(), Matrix6d::Identity(), 1});
	m.stereo(0, 1);
	m.map.shareInformation();
	EXPECT_TRUE(m.map.revisedEdges().empty()) << "alone it keeps all";
	m.stereo(0, 2);
	m.stereo(1, 2);
	m.map.shareInformation();
	EXPECT_EQ(m.map.revisedEdges(), (std::vector<int>{1, 2, 3}));
	EXPECT_EQ(m.map.edges()[0].share, 1);
	EXPECT_NEAR(m.map.edges()[1].share, 2.0 / 3, 1e-12);
	EXPECT_NEAR(m.map.edges()[1].information(0, 0), 4, 1e-12) << "its own stays";
	// The second edge between 0 and 1 in MRPT's graph, not the odometry.
	auto mrpts = m.graph.edges.lower_bound({0, 1});
	EXPECT_NEAR(localInformation(mrpts->second)(0, 0), 1, 1e-9);
	EXPECT_NEAR(localInformation((++mrpts)->second)(0, 0), 8.0 / 3, 1e-9);
	m.map.shareInformation();
	EXPECT_EQ(m.map.revisedEdges().size(), 3U) << "nothing new";
}

TEST(SlamMapShares, inThePoseGraph)
{
	TBoundMap m(3);
	m.stereo(0, 1);
	m.stereo(0, 2);
	m.stereo(1, 2);
	m.map.shareInformation();
	const CPoseGraph graph = toPoseGraph(m.map, TGraphLossOptions());
	EXPECT_NEAR(graph.edge(0).information(3, 3), 8.0 / 3, 1e-12);
	EXPECT_NEAR(graph.edge(0).loss.scale, 4 * std::sqrt(2.0 / 3), 1e-12)
		<< "the weight is that of the edge by its own information";
}

TEST(SlamMapShares, theOptimisersGraphFollows)
{
	// After a run, the engine's optimiser and a graph made anew of the map are of one opinion.
	const CStereoSlam& slam = defaultRun();
	int shared = 0;
	for (const auto& edge : slam.map().edges()) {
		EXPECT_GT(edge.share, 0);
		EXPECT_LE(edge.share, 1);
		EXPECT_EQ(edge.kind == EEdgeKind::ODOMETRY, edge.points.empty());
		shared += edge.share < 0.5;
	}
	EXPECT_GT(shared, 100);
	CPoseGraph graph = toPoseGraph(slam.map(), TGraphLossOptions(), TPriorOptions());
	CSparseOptimizer optimizer;
	optimizer.optimize(graph);
	double farthest = 0;
	for (int i = 0; i < slam.map().nodeCount(); i++)
		farthest =
			std::max(farthest, (graph.pose(i).translation() - slam.map().pose(i).translation()).norm());
	// The incremental optimiser, before makeExact().
	RecordProperty("farthest_um", int(1e6 * farthest));
	EXPECT_LT(farthest, 1e-3);
}

TEST(SlamMapShares, offIsIndependentEdges)
{
	TSetup setup = secondExperiment();
	setup.slam.loss.share_information = false;
	setup.stop_at_nodes = 8;
	const auto slam = run(setup);
	EXPECT_TRUE(slam->map().revisedEdges().empty());
	for (const auto& edge : slam->map().edges())
		EXPECT_EQ(edge.share, 1);
}
