// The map beside MRPT's graph: same content, odometry metres, composed covariances.
#include <gtest/gtest.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/graphslam/slam_parts.h>

#include <random_pose.h>

#include "survey.h"

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;

namespace
{
struct TBoundMap
{
	TSlamGraph graph;
	CSlamMap map;
	TBoundMap() { map.bind(graph); }
	void addNodes(int n)
	{
		for (int k = 0; k < n; k++)
			map.addNode({}, Isometry3d::Identity());
	}
	void addEdge(int from, int to, EEdgeKind kind, double path_length)
	{
		map.addEdge({from, to, kind, Isometry3d::Identity(), Matrix6d::Identity(), path_length});
	}
};

/** All distances by Floyd and Warshall. */
std::vector<std::vector<double>> allDistances(const CSlamMap& map)
{
	const size_t n = map.nodes().size();
	std::vector<std::vector<double>> d(n, std::vector<double>(n, std::numeric_limits<double>::infinity()));
	for (size_t i = 0; i < n; i++)
		d[i][i] = 0;
	for (const auto& e : map.edges()) {
		const auto a = size_t(e.from), b = size_t(e.to);
		d[a][b] = d[b][a] = std::min(d[a][b], e.kind == EEdgeKind::ODOMETRY ? e.path_length : 0);
	}
	for (size_t k = 0; k < n; k++)
		for (size_t i = 0; i < n; i++)
			for (size_t j = 0; j < n; j++)
				d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
	return d;
}
}  // namespace

TEST(SlamMap, mrptsGraphHoldsTheSameEdges)
{
	// A real run's edges, entered anew into a graph that the test can look into.
	const CSlamMap& run = defaultRun().map();
	TBoundMap m;
	for (int i = 0; i < run.nodeCount(); i++)
		m.map.addNode(run.node(i), run.pose(i));
	for (const auto& edge : run.edges())
		m.map.addEdge(edge);  // with its share

	ASSERT_EQ(m.graph.nodes.size(), size_t(run.nodeCount()));
	ASSERT_EQ(m.graph.edgeCount(), run.edges().size());
	for (int i = 0; i < run.nodeCount(); i++)
		EXPECT_LT(localCoordinates(run.pose(i), fromMrpt(m.graph.nodes.at(size_t(i)))).norm(), 1e-12)
			<< "node " << i;

	std::map<std::pair<int, int>, std::vector<TSlamEdge>> by_pair;
	for (const auto& edge : run.edges())
		by_pair[{edge.from, edge.to}].push_back(edge);
	for (const auto& [pair, edges] : by_pair) {
		const auto [first, last] = m.graph.edges.equal_range({size_t(pair.first), size_t(pair.second)});
		ASSERT_EQ(size_t(std::distance(first, last)), edges.size()) << pair.first << " to " << pair.second;
		auto mrpt_edge = first;	 // a multimap keeps the order of insertion
		for (const auto& edge : edges) {
			EXPECT_LT(localCoordinates(edge.T_from_to, fromMrpt(mrpt_edge->second.mean)).norm(), 1e-12);
			const Matrix6d information = localInformation(mrpt_edge->second);
			const Matrix6d counted = edge.share * edge.information;
			EXPECT_LT((information - counted).norm(), 1e-9 * counted.norm());
			++mrpt_edge;
		}
	}
}

TEST(SlamMap, odometryMetresAlongTheChain)
{
	TBoundMap m;
	m.addNodes(6);
	const double path[] = {0.5, 0.6, 0.7, 0.4, 0.55};
	for (int k = 0; k < 5; k++)
		m.addEdge(k, k + 1, EEdgeKind::ODOMETRY, path[k]);
	const auto to_last = m.map.odometryMetresTo(5);
	const double expected[] = {2.75, 2.25, 1.65, 0.95, 0.55, 0};
	for (size_t k = 0; k < 6; k++)
		EXPECT_NEAR(to_last[k], expected[k], 1e-12) << "node " << k;

	m.addEdge(0, 4, EEdgeKind::ROI, 99);  // a stereo edge passes no drift on, whatever its length
	const auto shorter = m.map.odometryMetresTo(5);
	const double with_loop[] = {0.55, 1.05, 1.65, 0.95, 0.55, 0};
	for (size_t k = 0; k < 6; k++)
		EXPECT_NEAR(shorter[k], with_loop[k], 1e-12) << "node " << k;
}

TEST(SlamMap, odometryMetresAgreeWithAllDistances)
{
	std::mt19937 rng(8);
	std::uniform_real_distribution<double> metres(0.3, 0.7);
	for (int n = 0; n < 10; n++) {
		TBoundMap m;
		m.addNodes(15);
		for (int k = 0; k < 14; k++)
			m.addEdge(k, k + 1, EEdgeKind::ODOMETRY, metres(rng));
		std::uniform_int_distribution<int> node(0, 14);
		for (int k = 0; k < 3; k++) {
			const int a = node(rng), b = node(rng);
			if (a != b) m.addEdge(a, b, k == 0 ? EEdgeKind::SEQUENTIAL : EEdgeKind::ROI, 0);
		}
		const auto all = allDistances(m.map);
		for (int to = 0; to < 15; to++) {
			const auto found = m.map.odometryMetresTo(to);
			for (size_t i = 0; i < 15; i++)
				EXPECT_NEAR(found[i], all[i][size_t(to)], 1e-12) << "map " << n << " node " << i;
		}
	}
}

TEST(SlamMap, relativePose)
{
	std::mt19937 rng(9);
	TBoundMap m;
	const Isometry3d T_0 = randomPose(rng, 5, 2), T_1 = randomPose(rng, 5, 2);
	m.map.addNode({}, T_0);
	m.map.addNode({}, T_1);
	EXPECT_LT(localCoordinates(T_0.inverse() * T_1, m.map.relativePose(0, 1)).norm(), 1e-12);
	m.map.setPose(1, T_0);
	EXPECT_LT(localCoordinates(Isometry3d::Identity(), m.map.relativePose(0, 1)).norm(), 1e-12);
}

TEST(ChainUncertainty, composesTheOdometryEdges)
{
	std::mt19937 rng(10);
	TBoundMap m;
	m.addNodes(4);
	std::vector<Matrix6d> cov;
	std::vector<Isometry3d> T;
	for (int k = 0; k < 3; k++) {
		T.push_back(randomPose(rng, 1, 1));
		cov.push_back(randomCovariance(rng, 0.01));
		m.map.addEdge({k, k + 1, EEdgeKind::ODOMETRY, T.back(), cov.back().inverse(), 1});
	}
	// A stereo edge does not count here.
	m.map.addEdge({0, 3, EEdgeKind::ROI, T[0] * T[1] * T[2], 1e9 * Matrix6d::Identity()});

	// d_03 = Ad(T_3_1) d_01 + Ad(T_3_2) d_12 + d_23, each independent.
	const Matrix6d A = adjoint((T[1] * T[2]).inverse()), B = adjoint(T[2].inverse());
	const Matrix6d expected_03 = A * cov[0] * A.transpose() + B * cov[1] * B.transpose() + cov[2];
	const Matrix6d expected_13 = B * cov[1] * B.transpose() + cov[2];
	CChainUncertainty chain;
	const auto found = chain.relativeCovariances(m.map, {0, 3, 1, 2}, 3);
	ASSERT_EQ(found.size(), 4u);
	EXPECT_LT((found[0] - expected_03).norm(), 1e-9 * expected_03.norm());
	EXPECT_EQ(found[1], Matrix6d(Matrix6d::Zero()));
	EXPECT_LT((found[2] - expected_13).norm(), 1e-9 * expected_13.norm());
	EXPECT_LT((found[3] - cov[2]).norm(), 1e-9 * cov[2].norm());
}

TEST(SlamMap, aRevisedOdometryEdgeIsTheSameInBothGraphs)
{
	TBoundMap m;
	m.addNodes(3);
	m.addEdge(0, 1, EEdgeKind::ODOMETRY, 1);
	m.addEdge(1, 2, EEdgeKind::ODOMETRY, 2);
	m.addEdge(1, 2, EEdgeKind::SEQUENTIAL, 0);
	TPoseEstimate revised;
	revised.T.translation() = Eigen::Vector3d(0.5, 0.1, -0.2);
	revised.cov = 0.01 * Matrix6d::Identity();
	revised.path_length = 0.6;
	Isometry3d T_odom_body = Isometry3d::Identity();
	T_odom_body.translation().x() = 7;
	m.map.reviseOdometry(2, revised, T_odom_body);
	ASSERT_EQ(m.map.revisedEdges(), std::vector<int>{1});
	EXPECT_EQ(m.map.edges()[1].T_from_to.matrix(), revised.T.matrix());
	EXPECT_EQ(m.map.edges()[1].path_length, 0.6);
	EXPECT_NEAR(m.map.edges()[1].information(0, 0), 100, 1e-9);
	EXPECT_EQ(m.map.edges()[2].T_from_to.matrix(), Isometry3d::Identity().matrix());
	EXPECT_EQ(m.map.node(2).T_odom_body.translation().x(), 7);
	const auto& mrpts = m.graph.edges.lower_bound({1, 2})->second;
	EXPECT_LT((fromMrpt(mrpts.mean).matrix() - revised.T.matrix()).norm(), 1e-12);
	EXPECT_THROW(m.map.reviseOdometry(0, revised, T_odom_body), CError);
}

TEST(SlamMap, lateReadingsReachTheGraphAsRevisedEdges)
{
	// A tenth of the DVL's pings come half a second late: each edge is revised, and the graph ends where that
	// of the log in order does.
	const auto edgesOfRun = [](bool late) {
		TStereoSlamOptions options = TSetup().slam;
		options.loss.share_information = false;	 // shares are revised, too
		CStereoSlam slam(
			options, survey().sensors, survey().ekf(), std::make_unique<CStereoImageLoader>(survey().rawlog),
			"");
		std::vector<mrpt::obs::CObservation::Ptr> waiting;
		int pings = 0;
		for (const auto& o : survey().observations) {
			if (slam.map().nodeCount() > 4) break;
			while (!waiting.empty() && stampOf(*o) - stampOf(*waiting.front()) > 0.4) {
				slam.add(waiting.front());
				waiting.erase(waiting.begin());
			}
			if (late && o->sensorLabel == "DVL" && ++pings % 10 == 0)
				waiting.push_back(o);
			else
				slam.add(o);
		}
		return std::make_pair(slam.map().edges(), slam.map().revisedEdges().size());
	};
	const auto [in_order, none] = edgesOfRun(false);
	const auto [late, revised] = edgesOfRun(true);
	EXPECT_EQ(none, 0U);
	EXPECT_GT(revised, 0U);
	const auto firstOdometry = [](const std::vector<TSlamEdge>& edges, int to) {
		for (const auto& e : edges)
			if (e.kind == EEdgeKind::ODOMETRY && e.to == to) return e.T_from_to;
		return Isometry3d::Identity();
	};
	for (int to = 1; to <= 3; to++)
		EXPECT_LT((firstOdometry(in_order, to).matrix() - firstOdometry(late, to).matrix()).norm(), 2e-3)
			<< "edge to node " << to;
}
