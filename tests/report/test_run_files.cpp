#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/report/run_files.h>
#include <temp_folder.h>

#include <cmath>

using namespace posidonia;
using namespace posidonia::testing;

TEST(RunFiles, RunInfoComesBack)
{
	const CTempFolder folder;
	const TRunInfo in{"auv-mission", "a \"title\"", "v",  "truth.tum",
					  true,			 1420070400.25, 12.5, {41.5, 3.25}};
	const TRunInfo out = readRunInfo(folder.write("file", runInfoJson(in)));
	EXPECT_EQ(out.app, in.app);
	EXPECT_EQ(out.title, in.title);
	EXPECT_EQ(out.truth, in.truth);
	EXPECT_EQ(out.interrupted, true);
	EXPECT_EQ(out.start, in.start);
	EXPECT_EQ(out.datum.longitude, 3.25);
}

TEST(RunFiles, NodesComeBackWithTheirCovariances)
{
	const CTempFolder folder;
	TNodeRow in;
	in.node = 7, in.stamp = 12.25, in.points = 321, in.altitude = 2.5, in.picture = "loops/000007.jpg";
	in.T_map_body.linear() = rotationFromYawPitchRoll(0.3, -0.1, 0.2);
	in.T_map_body.translation() = Eigen::Vector3d(1, -2, 3.5);
	const Matrix6d half = Matrix6d::Random();
	in.covariance = half * half.transpose();
	const auto rows = readNodes(folder.write("file", nodesCsv({in})));
	ASSERT_EQ(rows.size(), 1u);
	const TNodeRow& out = rows[0];
	EXPECT_EQ(out.node, 7);
	EXPECT_EQ(out.points, 321);
	EXPECT_EQ(out.picture, in.picture);
	EXPECT_LT((out.T_map_body.matrix() - in.T_map_body.matrix()).norm(), 1e-8);
	EXPECT_LT((out.covariance - in.covariance).norm(), 1e-7 * in.covariance.norm());
}

/** A vehicle that looks east is sure of its own forward direction: that is east, not north. */
TEST(RunFiles, CovarianceTurnsIntoMapAxes)
{
	Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
	T_map_body.linear() = rotationFromYawPitchRoll(M_PI / 2, 0, 0);
	Matrix6d own = Matrix6d::Identity();
	own(0, 0) = 0.01;
	const Matrix6d in_map = covarianceInMap(T_map_body, own);
	EXPECT_NEAR(in_map(0, 0), 1, 1e-12);
	EXPECT_NEAR(in_map(1, 1), 0.01, 1e-12);
	EXPECT_NEAR(in_map.trace(), own.trace(), 1e-12);
}

TEST(RunFiles, MatchesAndSensorsComeBack)
{
	const CTempFolder folder;
	const auto matches = readMatches(folder.write(
		"file", matchesCsv({{3, 9, 12.5, {{{1, 2}, {3, 4}}, {{5, 6}, {7, 8}}}}, {4, 9, 0, {}}})));
	ASSERT_EQ(matches.size(), 2u);
	EXPECT_EQ(matches[0].to, 9);
	EXPECT_EQ(matches[0].chi2, 12.5);
	ASSERT_EQ(matches[0].points.size(), 2u);
	EXPECT_EQ(matches[0].points[1].second, Eigen::Vector2d(7, 8));
	EXPECT_TRUE(matches[1].points.empty());
	const auto sensors = readSensorRows(folder.write(
		"file", sensorsCsv({{"DVL", 100, 5, 0.4, {{"gated", 7}, {"too late", 2}}}, {"GPS", 0, 0, 0, {}}})));
	ASSERT_EQ(sensors.size(), 2u);
	EXPECT_EQ(sensors[0].rejected.at("too late"), 2u);
	EXPECT_EQ(sensors[0].longest_gap, 0.4);
	EXPECT_TRUE(sensors[1].rejected.empty());
}

TEST(RunFiles, EventsKeepTheirCommas)
{
	const CTempFolder folder;
	const auto events = readEvents(folder.write(
		"file", "t,kind,text\n1.50,safety level,\"abort: no DVL, no altitude\"\n2.00,mission done,\"\"\n"));
	ASSERT_EQ(events.size(), 2u);
	EXPECT_EQ(events[0].text, "abort: no DVL, no altitude");
	EXPECT_EQ(events[1].kind, "mission done");
	EXPECT_EQ(events[1].text, "");
}

TEST(RunFiles, ATableReadsWordsAsNoNumber)
{
	const CTempFolder folder;
	const TNumberTable table = readNumberTable(folder.write("file", "t,level\n0.5,none\n1.5,abort\n"));
	EXPECT_EQ(table.column("t")[1], 1.5);
	EXPECT_TRUE(std::isnan(table.column("level")[0]));
	EXPECT_THROW(table.column("depth"), CError);
}

TEST(RunFiles, DamageNamesFileAndLine)
{
	const CTempFolder folder;
	const auto problemOf = [&](const auto& read, const std::string& text) -> std::string {
		try {
			read(folder.write("file", text));
		}
		catch (const CError& problem) {
			return problem.what();
		}
		return "(no error)";
	};
	EXPECT_HOLDS(problemOf(readMatches, "from,to,chi2,points\n1,2,3\n"), "file:2");
	EXPECT_HOLDS(problemOf(readMatches, "from,to,chi2,points\n1,2,3,4 5 6\n"), "file:2");
	EXPECT_HOLDS(
		problemOf(readSensorRows, "sensor,used,rate_hz,longest_gap_s,rejected\nDVL,1,1,1,gated\n"), "file:2");
	EXPECT_HOLDS(problemOf(readNodes, "node\n"), "header");
	EXPECT_HOLDS(problemOf(readRunInfo, "{}"), "file");
}
