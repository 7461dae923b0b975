// loops.csv: every candidate pair once a decider, with what became of it.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "survey.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
std::set<std::string> knownReasons()
{
	std::set<std::string> reasons{
		"over budget", "refused by the chi-square gate", "refused by the jump gate", "accepted on retry"};
	for (const auto status : allRegistrationStatuses())
		reasons.insert(toString(status));
	return reasons;
}
}  // namespace

TEST(CandidateRows, onceADeciderWithAReason)
{
	const CStereoSlam& slam = defaultRun();
	const auto reasons = knownReasons();
	std::set<std::tuple<int, int, EEdgeKind>> seen;
	for (const auto& row : slam.map().candidates) {
		EXPECT_TRUE(seen.insert({row.from, row.to, row.kind}).second)
			<< row.from << " to " << row.to << " twice";
		EXPECT_EQ(reasons.count(row.status), 1u) << "'" << row.status << "'";
		EXPECT_LT(row.from, row.to);
	}
	ASSERT_FALSE(seen.empty());
}

TEST(CandidateRows, acceptedRowsAreTheEdges)
{
	const CStereoSlam& slam = defaultRun();
	std::map<std::tuple<int, int, EEdgeKind>, Eigen::Isometry3d> accepted;
	for (const auto& row : slam.map().candidates)
		if (row.status == "accepted" || row.status == "accepted on retry")
			accepted[{row.from, row.to, row.kind}] = row.T_from_to;
	size_t stereo_edges = 0;
	for (const auto& edge : slam.map().edges()) {
		if (edge.kind == EEdgeKind::ODOMETRY) continue;
		stereo_edges++;
		const auto found = accepted.find({edge.from, edge.to, edge.kind});
		ASSERT_NE(found, accepted.end()) << "edge " << edge.from << " to " << edge.to;
		EXPECT_EQ(found->second.matrix(), edge.T_from_to.matrix());
	}
	EXPECT_EQ(accepted.size(), stereo_edges);
}

TEST(CandidateRows, sequentialAreThePreviousFew)
{
	const CStereoSlam& slam = defaultRun();
	std::map<int, std::vector<int>> from_of;
	for (const auto& row : slam.map().candidates)
		if (row.kind == EEdgeKind::SEQUENTIAL) from_of[row.to].push_back(row.from);
	for (int j = 1; j < slam.map().nodeCount(); j++) {
		std::vector<int> previous;
		for (int i = std::max(0, j - 4); i < j; i++)
			previous.push_back(i);
		EXPECT_EQ(from_of[j], previous) << "node " << j;
	}
}

TEST(CandidateRows, beyondTheBudgetIsToldAndNotRegistered)
{
	TSetup setup = secondExperiment();
	setup.slam.slam.edge_deciders = "CRoiStereoERD";
	setup.slam.roi.max_candidates = 2;
	setup.stop_at_nodes = 14;
	const auto slam = run(setup);
	std::map<int, int> registered, over_budget;
	for (const auto& row : slam->map().candidates) {
		EXPECT_GE(row.to - row.from, setup.slam.roi.min_node_gap);
		if (row.status == "over budget") {
			over_budget[row.to]++;
			EXPECT_FALSE(row.measured);
			EXPECT_EQ(row.matches, 0);
		}
		else
			registered[row.to]++;
	}
	ASSERT_FALSE(over_budget.empty());
	for (const auto& [j, count] : over_budget)
		EXPECT_EQ(registered[j], 2) << "node " << j;
	for (const auto& [j, count] : registered)
		EXPECT_LE(count, 2) << "node " << j;
}

TEST(CandidateRows, noPairIsCountedTwice)
{
	// Sequential edges that reach into the loops' range: the same key frames must not make two edges.
	TSetup setup = secondExperiment();
	setup.slam.sequential.neighbours = 7;
	setup.slam.roi.min_node_gap = 3;
	setup.slam.roi.min_overlap = 0.1;
	setup.stop_at_nodes = 12;
	const auto slam = run(setup);
	std::set<std::pair<int, int>> seen;
	int loops = 0;
	for (const auto& row : slam->map().candidates) {
		EXPECT_TRUE(seen.insert({row.from, row.to}).second)
			<< row.from << " to " << row.to << " by two deciders";
		loops += row.kind == EEdgeKind::ROI;
	}
	EXPECT_GT(loops, 0);
}

TEST(CandidateRows, acceptedOnesTellTheWeightOfTheirEdge)
{
	TSetup setup = secondExperiment();
	setup.stop_at_nodes = 8;
	const auto slam = run(setup);
	slam->makeExact();
	int below = 0;
	for (const auto& row : slam->map().candidates) {
		EXPECT_GT(row.weight, 0) << row.from << " to " << row.to;
		EXPECT_LE(row.weight, 1) << row.from << " to " << row.to;
		below += row.weight < 1;
		EXPECT_TRUE(row.accepted() || row.weight == 1) << row.from << " to " << row.to;
	}
	EXPECT_GT(below, 5) << "a Cauchy loss leaves none whole";
}

TEST(CandidateRows, csvHasALineARow)
{
	TCandidateRow refused{1, 9, EEdgeKind::ROI, "too few matches", 12};
	TCandidateRow accepted{2, 9, EEdgeKind::SEQUENTIAL, "accepted", 80, 60, 0.5};
	accepted.measured = true;
	accepted.T_from_to.translation() << 1, -2, 0.25;
	accepted.weight = 0.25;
	EXPECT_EQ(
		candidatesCsv({refused, accepted}),
		"from,to,kind,status,matches,inliers,rmse_px,tx,ty,tz,qx,qy,qz,qw,weight\n"
		"1,9,roi,too few matches,12,0,0.000000,,,,,,,,\n"
		"2,9,sequential,accepted,80,60,0.500000,1.000000000,-2.000000000,0.250000000,0.000000000000,0."
		"000000000000,"
		"0.000000000000,1.000000000000,0.2500\n");
}
