// Which nodes are tried: sphere, gap, predicted overlap, order.
#include <gtest/gtest.h>
#include <posidonia/graphslam/loop_candidates.h>
#include <posidonia/obs/frames.h>
#include <posidonia/vision/key_frame.h>

#include <random_pose.h>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
constexpr double kDepth = 2.5;

/** 320 x 240 px, 97 deg. */
TStereoCamera camera()
{
	return {320, 240, 141.5, 141.5, 159.5, 119.5, 0.12};
}
TStereoCamera squareCamera()
{
	return {240, 240, 141.5, 141.5, 119.5, 119.5, 0.12};
}

Isometry3d shifted(double right, double down)
{
	Isometry3d T = Isometry3d::Identity();
	T.translation() << right, down, 0;
	return T;
}
Isometry3d turned(double radians)
{
	Isometry3d T = Isometry3d::Identity();
	T.linear() = expSO3({0, 0, radians});
	return T;
}

/** Nodes at chosen places, all level, that look straight down; key frames with points at kDepth. */
struct TTestMap
{
	TSlamGraph graph;
	CSlamMap map;
	Isometry3d T_body_camera = Isometry3d::Identity();

	TTestMap() { map.bind(graph); }
	void add(double north, double east, double down = 0)
	{
		auto key_frame = std::make_shared<TKeyFrame>();
		key_frame->points.push_back(
			makeStereoPoint(camera(), {160, 120, 141.5 * 0.12 / kDepth}, 0.5, 0.1, 0));
		Isometry3d T = Isometry3d::Identity();
		T.translation() << north, east, down;
		map.addNode({0, T, key_frame}, T);
	}
	std::vector<TCandidate> candidates(const TRoiOptions& options) const
	{
		return candidatesInRoi(map, map.lastNode(), options, camera(), T_body_camera);
	}
};

std::vector<int> nodesOf(const std::vector<TCandidate>& candidates)
{
	std::vector<int> nodes;
	for (const auto& c : candidates)
		nodes.push_back(c.node);
	return nodes;
}

TRoiOptions anyOverlap()
{
	TRoiOptions options;
	options.min_overlap = 0;
	return options;
}
}  // namespace

TEST(PredictedOverlap, knownCases)
{
	const double width = 320 / 141.5 * kDepth, height = 240 / 141.5 * kDepth;  // of the footprint [m]
	EXPECT_EQ(predictedOverlap(camera(), Isometry3d::Identity(), kDepth), 1);
	EXPECT_EQ(predictedOverlap(camera(), shifted(2 * width, 0), kDepth), 0);
	EXPECT_NEAR(predictedOverlap(camera(), shifted(width / 2, 0), kDepth), 0.5, 0.05);
	EXPECT_NEAR(predictedOverlap(camera(), shifted(0, height / 3), kDepth), 2.0 / 3, 0.05);
	EXPECT_NEAR(predictedOverlap(camera(), shifted(width / 2, height / 2), kDepth), 0.25, 0.05);
}

TEST(PredictedOverlap, turnedPictures)
{
	// A square turned by 90 degrees covers itself; turned by 45 degrees an octagon: 2 (sqrt 2 - 1).
	EXPECT_NEAR(predictedOverlap(squareCamera(), turned(M_PI / 2), kDepth), 1, 0.01);
	EXPECT_NEAR(predictedOverlap(squareCamera(), turned(M_PI / 4), kDepth), 2 * (std::sqrt(2) - 1), 0.05);
	// 320 x 240 turned by 90 degrees: the middle square of it, 240 / 320.
	EXPECT_NEAR(predictedOverlap(camera(), turned(M_PI / 2), kDepth), 0.75, 0.05);
	EXPECT_EQ(predictedOverlap(camera(), turned(M_PI), kDepth), 1);
	// Looking away.
	Isometry3d away = Isometry3d::Identity();
	away.linear() = expSO3({M_PI, 0, 0});
	EXPECT_EQ(predictedOverlap(camera(), away, kDepth), 0);
}

TEST(PredictedOverlap, higherSeesMore)
{
	Isometry3d up = Isometry3d::Identity();
	up.translation().z() = kDepth;	// the floor is twice as far from i
	EXPECT_EQ(predictedOverlap(camera(), up, kDepth), 1);
	// Camera j at twice the height of i: i sees the middle quarter of j's picture.
	Isometry3d down = Isometry3d::Identity();
	down.translation().z() = -kDepth / 2;
	EXPECT_NEAR(predictedOverlap(camera(), down, kDepth), 0.25, 0.1);
}

TEST(MedianDepth, ofPointsAndOfNone)
{
	TKeyFrame key_frame;
	EXPECT_EQ(medianDepth(key_frame), 0);
	for (double z : {9.0, 2.0, 3.0})
		key_frame.points.push_back(makeStereoPoint(camera(), {160, 120, 141.5 * 0.12 / z}, 0.5, 0.1, 0));
	EXPECT_NEAR(medianDepth(key_frame), 3, 1e-9);
}

TEST(CandidatesInRoi, sphereAndGap)
{
	TTestMap m;
	m.add(3.99, 0);		 // 0: in
	m.add(4.01, 0);		 // 1: out
	m.add(2.4, 0, 3.3);	 // 2: 4.08 m away in three dimensions: out, though 2.4 m in the plane
	m.add(0, -3);		 // 3: in
	m.add(0, 0);		 // 4: in, five steps back
	for (int k = 0; k < 4; k++)
		m.add(0, 0);  // 5 to 8: too recent
	m.add(0, 0);	  // 9: the newest
	TRoiOptions options = anyOverlap();
	options.radius = 4;
	options.min_node_gap = 5;
	auto nodes = nodesOf(m.candidates(options));
	EXPECT_EQ(nodes.front(), 4);
	std::sort(nodes.begin(), nodes.end());
	EXPECT_EQ(nodes, (std::vector<int>{0, 3, 4}));
	options.min_node_gap = 2;
	EXPECT_EQ(m.candidates(options).size(), 6u);
}

TEST(CandidatesInRoi, bestOverlapFirstTiesToTheOlder)
{
	TTestMap m;
	const double norths[] = {2.0, 0.5, 1.0, 0.5, 0.0};
	for (double north : norths)
		m.add(north, 0);
	for (int k = 0; k < 4; k++)
		m.add(9, 9);
	m.add(0, 0);
	TRoiOptions options = anyOverlap();
	options.radius = 4;
	options.min_node_gap = 5;
	const auto candidates = m.candidates(options);
	EXPECT_EQ(nodesOf(candidates), (std::vector<int>{4, 1, 3, 2, 0}));
	for (size_t k = 1; k < candidates.size(); k++)
		EXPECT_GE(candidates[k - 1].overlap, candidates[k].overlap);
	EXPECT_EQ(candidates.front().overlap, 1);
}

TEST(CandidatesInRoi, leastOverlap)
{
	TTestMap m;
	m.add(0, 1);	// share of the width 5.65 m: 0.82
	m.add(0, 3.5);	// 0.38
	for (int k = 0; k < 4; k++)
		m.add(9, 9);
	m.add(0, 0);
	m.T_body_camera.linear() = expSO3({0, 0, M_PI / 2});  // picture's right = starboard
	TRoiOptions options;
	options.min_overlap = 0.5;
	EXPECT_EQ(nodesOf(m.candidates(options)), (std::vector<int>{0}));
	options.min_overlap = 0.3;
	EXPECT_EQ(nodesOf(m.candidates(options)), (std::vector<int>{0, 1}));
}

TEST(CandidatesInRoi, noneBeforeTheGap)
{
	TTestMap m;
	for (int k = 0; k < 5; k++) {
		m.add(0, 0);
		EXPECT_TRUE(m.candidates(anyOverlap()).empty()) << k << " nodes before";
	}
	m.add(0, 0);
	EXPECT_EQ(m.candidates(anyOverlap()).size(), 1u);
}

TEST(CandidatesInRoi, theSphereGrowsWithTheUncertainty)
{
	TTestMap m;
	m.add(0, 6);   // 0
	m.add(0, 9);   // 1
	m.add(0, 12);  // 2
	for (int k = 0; k < 4; k++)
		m.add(40, 40);
	m.add(0, 0);  // 7
	TRoiOptions options;
	options.radius = 4;
	options.radius_max = 10;
	options.sigmas = 3;
	const auto at = [&](double sigma) {
		return nodesOf(
			candidatesInRoi(m.map, 7, options, camera(), m.T_body_camera, std::vector<double>(8, sigma)));
	};
	EXPECT_TRUE(at(0).empty());
	EXPECT_TRUE(at(1).empty()) << "3 m of reach: the sphere stays at 4 m";
	EXPECT_EQ(at(2.1), (std::vector<int>{0})) << "6.3 m";
	EXPECT_EQ(at(3.1), (std::vector<int>{0, 1})) << "9.3 m: the nearest first";
	EXPECT_EQ(at(30), (std::vector<int>{0, 1})) << "bounded by 10 m";
	options.sigmas = 0;
	EXPECT_TRUE(at(30).empty()) << "constant";
}

TEST(CandidatesInRoi, onlyPossibleOnesComeLast)
{
	TTestMap m;
	m.add(0, 3);	// 0: no overlap along the width of 4.24 m, possible within 3 m
	m.add(0, 0.5);	// 1: likely
	m.add(0, 4.5);	// 2: too far from likely; possible when moved by 3 m
	m.add(0, 1);	// 3: likely
	for (int k = 0; k < 4; k++)
		m.add(40, 40);
	m.add(0, 0);
	TRoiOptions options;
	options.min_overlap = 0.5;
	options.radius = 8;
	const std::vector<double> sigma(9, 1);
	const auto candidates = candidatesInRoi(m.map, 8, options, camera(), m.T_body_camera, sigma);
	EXPECT_EQ(nodesOf(candidates), (std::vector<int>{1, 3, 0, 2}));
	for (const auto& c : candidates) {
		EXPECT_EQ(c.only_possible, c.node == 0 || c.node == 2) << "node " << c.node;
		EXPECT_GE(c.overlap, 0.5) << "node " << c.node;
	}
	// Without uncertainty, and with none asked for, the likely ones alone.
	EXPECT_EQ(
		nodesOf(candidatesInRoi(m.map, 8, options, camera(), m.T_body_camera)), (std::vector<int>{1, 3}));
	EXPECT_EQ(
		nodesOf(candidatesInRoi(m.map, 8, options, camera(), m.T_body_camera, std::vector<double>(9, 0))),
		(std::vector<int>{1, 3}));
}
