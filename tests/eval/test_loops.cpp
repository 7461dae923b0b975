#include "eval_testing.h"

#include <posidonia/eval/loop_evaluation.h>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Isometry3d;

namespace
{
const std::string kHeader = "from,to,kind,status,matches,inliers,rmse_px,tx,ty,tz,qx,qy,qz,qw\n";

/** Nodes 0 ... 19 out along x, 1 m apart, and 20 ... 39 back over the same places. */
std::map<std::uint64_t, Isometry3d> thereAndBack()
{
	std::map<std::uint64_t, Isometry3d> truth;
	for (int i = 0; i < 40; i++) {
		Isometry3d T = Isometry3d::Identity();
		T.translation() << (i < 20 ? i : 39 - i), 0, 3.5;
		T.linear() = rotationFromYawPitchRoll(i < 20 ? 0 : M_PI, 0, 0);
		truth[static_cast<std::uint64_t>(i)] = T;
	}
	return truth;
}

TLoopRow row(
	const std::map<std::uint64_t, Isometry3d>& truth, std::uint64_t from, std::uint64_t to,
	const std::string& status, const Isometry3d& error = Isometry3d::Identity(),
	const std::string& kind = "roi")
{
	TLoopRow r;
	r.from = from;
	r.to = to;
	r.kind = kind;
	r.status = status;
	if (r.accepted()) r.T_from_to = truth.at(from).inverse() * truth.at(to) * error;
	return r;
}

Isometry3d offBy(double metres, double degrees)
{
	Vector6d d = Vector6d::Zero();
	d[0] = metres;
	d[5] = degrees * M_PI / 180;
	return retract(Isometry3d::Identity(), d);
}
}  // namespace

TEST(LoopsFile, ReadsWhatIsDocumented)
{
	const CTextFile file(
		kHeader + "3,40,roi,accepted,55,41,0.52,1,2,3,0,0,0.6,0.8\n" +
		"4,40,roi,too few matches,7,,,,,,,,,\n" + "39,40,sequential,over budget,,,,,,,,,,\n");
	const auto rows = readLoops(file.path());
	ASSERT_EQ(rows.size(), 3u);
	EXPECT_EQ(rows[0].from, 3u);
	EXPECT_EQ(rows[0].to, 40u);
	EXPECT_EQ(rows[0].inliers, 41);
	EXPECT_DOUBLE_EQ(rows[0].rmse, 0.52);
	EXPECT_TRUE(rows[0].accepted());
	EXPECT_EQ(rows[0].T_from_to->translation(), Eigen::Vector3d(1, 2, 3));
	EXPECT_NEAR(yawPitchRoll(rows[0].T_from_to->linear())[0], 2 * std::atan2(0.6, 0.8), 1e-12);
	EXPECT_EQ(rows[1].status, "too few matches");
	EXPECT_TRUE(rows[1].tried());
	EXPECT_FALSE(rows[1].T_from_to.has_value());
	EXPECT_FALSE(rows[2].tried());
	EXPECT_TRUE(rows[2].consecutive());
	EXPECT_TRUE(readLoops(CTextFile(kHeader).path()).empty());
}

TEST(LoopsFile, ReadsTheWeightsOfEdges)
{
	const CTextFile file(
		"from,to,kind,status,matches,inliers,rmse_px,tx,ty,tz,qx,qy,qz,qw,weight\n"
		"3,40,roi,accepted,55,41,0.52,1,2,3,0,0,0.6,0.8,0.7\n"
		"4,40,roi,accepted,55,41,0.52,1,2,3,0,0,0.6,0.8,0.1\n"
		"5,40,roi,too few matches,7,,,,,,,,,,\n");
	const auto rows = readLoops(file.path());
	ASSERT_EQ(rows.size(), 3u);
	EXPECT_EQ(rows[0].weight, 0.7);
	EXPECT_FALSE(rows[0].rejected());
	EXPECT_TRUE(rows[1].rejected());
	EXPECT_FALSE(rows[2].weight.has_value());
	EXPECT_FALSE(rows[2].rejected());
}

TEST(LoopsFile, ErrorsNameFileAndLine)
{
	const std::vector<std::pair<std::string, std::string>> cases{
		{"3,40,roi,accepted,55,41,0.5,1,2,3,0,0,0\n", ":2: 13 columns, expected 14"},
		{"3,40,roi,accepted,55,41,0.5,,,,,,,\n", ":2: an accepted pair without its pose"},
		{"-3,40,roi,no,55,41,0.5,,,,,,,\n", ":2: the node id -3 is negative"},
		{"3,4.5,roi,no,55,41,0.5,,,,,,,\n", ":2: '4.5' is not a whole number"},
		{"3,40,roi,no,55,41,0.5,1,,,,,,\n", ":2: '' is not a number"}};
	for (const auto& [line, problem] : cases) {
		const CTextFile file(kHeader + line);
		expectContains(errorOf([&f = file] { readLoops(f.path()); }), file.path() + problem);
	}
	const CTextFile other("from,to\n1,2\n");
	expectContains(errorOf([&] { readLoops(other.path()); }), ":1: is not the header of loops.csv");
}

TEST(Loops, FalseEdgesAreThoseOffTheTruth)
{
	const auto truth = thereAndBack();
	const std::vector<TLoopRow> rows{
		row(truth, 0, 39, "accepted", offBy(0.29, 0)),
		row(truth, 1, 38, "accepted", offBy(0.31, 0)),
		row(truth, 37, 2, "accepted", offBy(0, 4.9)),
		row(truth, 3, 36, "accepted", offBy(0, 5.1)),
		row(truth, 4, 35, "too few matches"),
		row(truth, 5, 6, "accepted", offBy(1, 0), "sequential"),
		row(truth, 5, 6, "accepted", offBy(1, 0), "odometry")};
	const TLoopEvaluation e = evaluateLoops(rows, truth, TFootprintCamera());
	EXPECT_EQ(e.loops.accepted, 4);
	EXPECT_EQ(e.loops.wrong, 2);
	EXPECT_DOUBLE_EQ(*e.loops.precision(), 0.5);
	EXPECT_NEAR(e.loops.translation.max, 0.31, 1e-12);
	EXPECT_NEAR(e.loops.rotation.max, 5.1 * M_PI / 180, 1e-9);
	EXPECT_EQ(e.sequential.wrong, 1);
	EXPECT_EQ(e.statuses.at("accepted"), 4);
	EXPECT_EQ(e.statuses.at("too few matches"), 1);
}

/** Footprints are 2.5 * 480 / 283 = 4.24 m long: nodes up to 2.12 m apart overlap by more than half, so 2 m.
 */
TEST(Loops, RecallCountsPairsOnceAndApartForTriedAndAll)
{
	const auto truth = thereAndBack();
	int expected = 0;
	for (int i = 0; i < 40; i++)
		for (int j = i + 11; j < 40; j++) {
			const double apart = std::abs((i < 20 ? i : 39 - i) - (j < 20 ? j : 39 - j));
			if (apart <= 2) expected++;
		}
	std::vector<TLoopRow> rows{
		row(truth, 0, 39, "accepted"),
		row(truth, 39, 0, "accepted"),
		row(truth, 1, 39, "too few matches"),
		row(truth, 2, 39, "over budget"),
		row(truth, 2, 38, "accepted", offBy(1, 0)),
		row(truth, 0, 30, "RANSAC failed"),
		row(truth, 20, 25, "accepted")};
	rows.push_back(rows[0]);
	rows.back().to = 99;
	const TLoopEvaluation e = evaluateLoops(rows, truth, TFootprintCamera());
	EXPECT_EQ(e.overlapping, expected);
	EXPECT_EQ(e.overlapping_tried, 3) << "(0,39), (1,39), (2,38)";
	EXPECT_EQ(e.overlapping_found, 1) << "(0,39): (2,38) is false, (20,25) is within the gap";
	EXPECT_DOUBLE_EQ(*e.recallOfTried(), 1.0 / 3);
	EXPECT_DOUBLE_EQ(*e.recallOfAll(), 1.0 / expected);
	EXPECT_EQ(e.without_truth, 1);
}

TEST(Loops, EveryOptionHasItsEffect)
{
	const auto truth = thereAndBack();
	const std::vector<TLoopRow> rows{row(truth, 0, 39, "accepted", offBy(0.2, 3))};
	const TFootprintCamera camera;
	const TLoopEvaluationOptions defaults;
	TLoopEvaluationOptions o = defaults;
	o.max_translation_error = 0.1;
	EXPECT_EQ(evaluateLoops(rows, truth, camera, o).loops.wrong, 1);
	o = defaults;
	o.max_rotation_error = 0.04;
	EXPECT_EQ(evaluateLoops(rows, truth, camera, o).loops.wrong, 1);
	const int usual = evaluateLoops(rows, truth, camera).overlapping;
	o = defaults;
	o.min_overlap = 0.9;
	EXPECT_LT(evaluateLoops(rows, truth, camera, o).overlapping, usual);
	o = defaults;
	o.min_node_gap = 30;
	EXPECT_LT(evaluateLoops(rows, truth, camera, o).overlapping, usual);
	TFootprintCamera shallow = camera;
	shallow.floor_depth = 4.0;
	EXPECT_LT(evaluateLoops(rows, truth, shallow).overlapping, usual);
}

TEST(Loops, MetricsNameBothRecallsAndLeaveOutWhatHasNoValue)
{
	const auto truth = thereAndBack();
	const TMetrics rows =
		loopMetrics("loops", evaluateLoops({row(truth, 0, 39, "accepted")}, truth, TFootprintCamera()));
	EXPECT_EQ(metric(rows, "loops.precision"), 1);
	EXPECT_EQ(metric(rows, "loops.recall_of_tried"), 1);
	EXPECT_GT(metric(rows, "loops.recall_of_all"), 0);
	EXPECT_LT(metric(rows, "loops.recall_of_all"), 1);
	expectContains(errorOf([&] { metric(rows, "loops.sequential.precision"); }), "no row");
	for (const auto& r : loopMetrics("loops", evaluateLoops({}, {}, TFootprintCamera())))
		EXPECT_TRUE(std::isfinite(r.value)) << r.what;
}
