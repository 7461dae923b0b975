#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/edge_residual.h>
#include <posidonia/posegraph/g2o_file.h>

#include "random_graph.h"

#include <cstdio>
#include <fstream>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** A file of the test's own, removed with it. */
class G2oFile : public ::testing::Test
{
   protected:
	~G2oFile() override { std::remove(path.c_str()); }
	void write(const std::string& text) const { std::ofstream(path) << text; }
	std::string errorOf(const std::string& text) const
	{
		write(text);
		try {
			readG2o(path);
		}
		catch (const CError& error) {
			return error.what();
		}
		return "(no error)";
	}
	std::string path = ::testing::TempDir() + "posidonia_" +
					   ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".g2o";
};

const std::string kVertices = "VERTEX_SE3:QUAT 5 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 3 1 0 0 0 0 0 1\n";
const std::string kIdentity = " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n";
}  // namespace

TEST_F(G2oFile, RoundTripKeepsGraphToTheLastDigits)
{
	auto planted = plantedGraph(6, 30, 40, 0.1, true);	// rotations up to pi, full information
	planted.graph.setFixed(4, true);
	std::vector<long long> ids;
	for (int i = 0; i < 30; i++)
		ids.push_back(1000000000000LL + 7 * i);
	writeG2o(path, planted.graph, ids);
	const auto back = readG2o(path);
	EXPECT_EQ(back.file_ids, ids);
	EXPECT_LT(largestDifference(back.graph.poses(), planted.graph.poses()), 1e-13);
	ASSERT_EQ(back.graph.edgeCount(), planted.graph.edgeCount());
	for (int i = 0; i < 30; i++)
		EXPECT_EQ(back.graph.isFixed(i), i == 0 || i == 4) << "node " << i;
	for (int k = 0; k < int(back.graph.edgeCount()); k++) {
		const auto &a = planted.graph.edge(k), &b = back.graph.edge(k);
		EXPECT_EQ(a.from, b.from);
		EXPECT_EQ(a.to, b.to);
		EXPECT_EQ(a.information, b.information) << "edge " << k;
		EXPECT_LT(localCoordinates(a.T_from_to, b.T_from_to).norm(), 1e-14) << "edge " << k;
	}
	EXPECT_NEAR(chi2(back.graph), chi2(planted.graph), 1e-9 * chi2(planted.graph));
}

TEST_F(G2oFile, RotationInformationIsOfTheQuaternionsVectorPart)
{
	write(kVertices + "EDGE_SE3:QUAT 5 3 1 0 0 0 0 0 1" + kIdentity);
	auto file = readG2o(path);
	EXPECT_EQ(file.graph.edge(0).information, Matrix6d(Matrix6d::Identity()));
	// g2o's chi2: 4 (sin(angle / 2))^2 of the turned node
	file.graph.setPose(0, retract(file.graph.pose(0), (Vector6d() << 0, 0, 0, 2.5, 0, 0).finished()));
	EXPECT_NEAR(chi2(file.graph), 4 * std::pow(std::sin(1.25), 2), 1e-12);
}

TEST_F(G2oFile, IdsAreSortedAndTheLowestIsFixedWithoutFix)
{
	write("# comment\r\n\n" + kVertices + "EDGE_SE3:QUAT 5 3 1 0 0 0 0 0 1" + kIdentity);
	const auto file = readG2o(path);
	EXPECT_EQ(file.file_ids, (std::vector<long long>{3, 5}));
	EXPECT_TRUE(file.graph.isFixed(0));
	EXPECT_FALSE(file.graph.isFixed(1));
	EXPECT_EQ(file.graph.edge(0).from, 1);
	write(kVertices + "FIX 5\n");
	EXPECT_TRUE(readG2o(path).graph.isFixed(1));
	EXPECT_FALSE(readG2o(path).graph.isFixed(0));
}

TEST_F(G2oFile, MalformedLinesAreNamed)
{
	const std::string edge = "EDGE_SE3:QUAT 5 3 1 0 0 0 0 0 1";
	const std::vector<std::pair<std::string, std::string>> bad = {
		{"VERTEX_SE3:QUAT 7 0 0 0 0 0 0\n", "ends too early"},
		{"VERTEX_SE3:QUAT 7 0 0 zero 0 0 0 1\n", "'zero' is not a number"},
		{"VERTEX_SE3:QUAT 7.5 0 0 0 0 0 0 1\n", "'7.5' is not a number"},
		{"VERTEX_SE3:QUAT 7 0 0 0 0 0 0 0\n", "unit length"},
		{"VERTEX_SE3:QUAT 7 0 nan 0 0 0 0 1\n", "not finite"},
		{"VERTEX_SE3:QUAT 5 0 0 0 0 0 0 1\n", "twice"},
		{"VERTEX_SE3:QUAT 7 0 0 0 0 0 0 1 9\n", "more than belongs"},
		{edge + " 1 0 0\n", "ends too early"},
		{edge + " -1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n", "positive definite"},
		{edge + " inf 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n", "positive definite"},
		{"EDGE_SE3:QUAT 5 8 1 0 0 0 0 0 1" + kIdentity, "no vertex 8"},
		{"EDGE_SE3:QUAT 5 5 1 0 0 0 0 0 1" + kIdentity, "same node"},
		{"FIX 9\n", "no vertex 9"},
		{"FIX\n", "ends too early"},
		{"EDGE_SE2 1 2 3\n", "unknown tag 'EDGE_SE2'"},
	};
	for (const auto& [line, problem] : bad) {
		const std::string message = errorOf(kVertices + line);
		EXPECT_EQ(message.find(path + ":3: "), 0u) << line << message;
		EXPECT_NE(message.find(problem), std::string::npos) << line << message;
	}
}

TEST_F(G2oFile, EmptyOrAbsentFilesAndBadIdsAreErrors)
{
	EXPECT_NE(errorOf("").find("no VERTEX_SE3:QUAT"), std::string::npos);
	EXPECT_THROW(readG2o(path + ".absent"), CError);
	const auto planted = plantedGraph(6, 3, 0, 0.1, true);
	EXPECT_THROW(writeG2o(path, planted.graph, {1, 2}), CError);
	EXPECT_THROW(writeG2o(path, planted.graph, {1, 2, 2}), CError);
}
