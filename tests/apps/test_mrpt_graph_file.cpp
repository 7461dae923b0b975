#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <posidonia/base/error.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/mrpt_graph_file.h>
#include <synthetic_graphs.h>
#include <temp_folder.h>

#include <iomanip>

using namespace posidonia;
using namespace posidonia::testing;
using TMrptGraph = mrpt::graphs::CNetworkOfPoses3DInf;
using TNode = mrpt::graphs::TNodeID;

namespace
{
/** A small sphere, so with rotations of all sizes, each edge with another full information matrix. */
CPoseGraph tiltedGraph()
{
	TSphere options;
	options.laps = 5;
	options.ring = 8;
	options.radius = 3;
	options.sigmas = {1e-3, 1e-3};
	CPoseGraph graph = sphere(options).graph;
	std::srand(1);	// Eigen's Random()
	for (int k = 0; k < static_cast<int>(graph.edgeCount()); k++) {
		TPoseEdge edge = graph.edge(k);
		const Matrix6d A = Matrix6d::Random();
		edge.information = A * A.transpose() + 0.1 * Matrix6d::Identity();
		graph.setEdge(k, edge);
	}
	return graph;
}

TMrptGraph toMrpt(const CPoseGraph& graph)
{
	TMrptGraph out;
	for (int i = 0; i < static_cast<int>(graph.nodeCount()); i++)
		out.nodes[static_cast<TNode>(10 + 3 * i)] =
			TMrptGraph::global_pose_t(posidonia::toMrpt(graph.pose(i)));
	for (const TPoseEdge& e : graph.edges())
		out.insertEdge(
			static_cast<TNode>(10 + 3 * e.from), static_cast<TNode>(10 + 3 * e.to),
			toMrptGaussianInf(e.T_from_to, e.information));
	out.root = 10;
	return out;
}

/** MRPT's own text, with enough digits. */
std::string exactText(const TMrptGraph& graph)
{
	std::ostringstream out;
	out << std::setprecision(17);
	graph.writeAsText(out);
	return out.str();
}

constexpr const char* kEdge = "EDGE3 0 1 1 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";
}  // namespace

TEST(MrptGraphFile, ReadsBackWhatMrptWrites)
{
	const CTempFolder folder;
	const CPoseGraph graph = tiltedGraph();
	const TMrptGraphFile read = readMrptGraph(folder.write("g.graph", exactText(toMrpt(graph))));
	ASSERT_EQ(read.graph.nodeCount(), graph.nodeCount());
	ASSERT_EQ(read.graph.edgeCount(), graph.edgeCount());
	EXPECT_EQ(read.edges_without_information, 0);
	for (int i = 0; i < static_cast<int>(graph.nodeCount()); i++) {
		EXPECT_EQ(read.file_ids[static_cast<size_t>(i)], 10 + 3 * i);
		EXPECT_LT((read.graph.pose(i).matrix() - graph.pose(i).matrix()).norm(), 1e-12) << "node " << i;
		EXPECT_EQ(read.graph.isFixed(i), i == 0) << "node " << i;
	}
	for (const TPoseEdge& edge : read.graph.edges()) {	// MRPT sorts them by their ends
		const auto same = std::find_if(graph.edges().begin(), graph.edges().end(), [&](const TPoseEdge& e) {
			return e.from == edge.from && e.to == edge.to;
		});
		ASSERT_NE(same, graph.edges().end());
		EXPECT_LT((same->T_from_to.matrix() - edge.T_from_to.matrix()).norm(), 1e-12)
			<< edge.from << " -> " << edge.to;
		EXPECT_LT((same->information - edge.information).norm(), 1e-10 * same->information.norm())
			<< edge.from << " -> " << edge.to;
	}
	EXPECT_NEAR(chi2(read.graph), chi2(graph), 1e-10 * chi2(graph));
}

TEST(MrptGraphFile, Chi2IsMrptsOwnForSmallResiduals)
{
	const CTempFolder folder;
	const TMrptGraph mrpt_graph = toMrpt(tiltedGraph());
	const double ours = chi2(readMrptGraph(folder.write("g.graph", exactText(mrpt_graph))).graph);
	EXPECT_GT(ours, 1e-5);
	EXPECT_NEAR(ours, mrpt_graph.chi2(), 0.02 * ours) << "equal to first order in the residuals";
}

TEST(MrptGraphFile, ReadsTheFileThatMrptSaves)
{
	const CTempFolder folder;
	const CPoseGraph graph = tiltedGraph();
	toMrpt(graph).saveToTextFile(folder / "six-digits.graph");
	const CPoseGraph read = readMrptGraph(folder / "six-digits.graph").graph;
	for (int i = 0; i < static_cast<int>(graph.nodeCount()); i++)
		EXPECT_LT((read.pose(i).matrix() - graph.pose(i).matrix()).norm(), 1e-4) << "node " << i;
}

TEST(MrptGraphFile, TakesAnnotationsEquivalencesAndMissingInformation)
{
	const CTempFolder folder;
	const TMrptGraphFile read = readMrptGraph(folder.write(
		"g.graph",
		"# a comment\nVERTEX3 0 0 0 0 0 0 0 | begin\nvertex3 1 1 0 0 0 0 0.5\r\nVERTEX3 2 1 0 0 0 0 0.5\n"
		"EQUIV 2 1\nEDGE3 0 2 1 0 0 0 0 0.5\nEDGE3 1 2 0 0 0 0 0 0\nFIX 1\n"));
	ASSERT_EQ(read.graph.nodeCount(), 2u);
	ASSERT_EQ(read.graph.edgeCount(), 1u) << "the edge between equal nodes says nothing";
	EXPECT_EQ(read.graph.edge(0).to, 1);
	EXPECT_FALSE(read.graph.isFixed(0));
	EXPECT_TRUE(read.graph.isFixed(1));
	EXPECT_EQ(read.edges_without_information, 2);
	EXPECT_NEAR(yawPitchRoll(read.graph.pose(1).linear())[0], 0.5, 1e-15) << "the last angle is the yaw";
	// MRPT's identity is over yaw, pitch and roll, which at zero pitch and roll are the body's axes.
	EXPECT_LT((read.graph.edge(0).information - Matrix6d::Identity()).norm(), 1e-12);
}

TEST(MrptGraphFile, NamesTheBadLine)
{
	const CTempFolder folder;
	const std::string start = "VERTEX3 0 0 0 0 0 0 0\nVERTEX3 1 1 0 0 0 0 0\n";
	const std::vector<std::pair<std::string, std::string>> bad{
		{"VERTEX3 1 0 0 0 0 0 0\n", ":3: vertex 1 is there twice"},
		{"VERTEX3 2 0 0 0 0 0\n", ":3: the line ends too early"},
		{"VERTEX3 2 0 0 0 0 0 0 0\n", ":3: '0' is more than belongs"},
		{"VERTEX3 2 0 0 x 0 0 0\n", ":3: 'x' is not a number"},
		{"VERTEX3 2 0 0 nan 0 0 0\n", ":3: the pose is not finite"},
		{"EDGE3 0 1 1 0 0 0 0 0 1 2 3\n", ":3: the line ends too early"},
		{"EDGE3 0 7 1 0 0 0 0 0\n", ":3: there is no vertex 7"},
		{"EDGE3 0 0 1 0 0 0 0 0\n", ":3: edge 0"},
		{"EDGE3 0 1 1 0 0 0 1.5707963267948966 0\n", ":3: at 90 deg of pitch"},
		{"EDGE3 0 1 1 0 0 0 0 0 -1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n", ":3: edge 0"},
		{"VERTEX2 3 0 0 0\n", ":3: unknown tag 'VERTEX2' (2D graphs are not read)"},
		{"EDGE_SE3:QUAT 0 1\n", ":3: a g2o line"},
		{"FIX 0\nFIX 1\n", ":4: a second FIX"},
		{"FIX 5\n", ":3: there is no vertex 5"}};
	for (const auto& [line, problem] : bad) {
		const std::string path = folder.write("bad.graph", start + line);
		EXPECT_HOLDS(errorOf<CError>([&] { readMrptGraph(path); }), "bad.graph" + problem) << line;
	}
	EXPECT_HOLDS(
		errorOf<CError>([&] { readMrptGraph(folder.write("none.graph", kEdge)); }), "no VERTEX3 line");
	EXPECT_EQ(readMrptGraph(folder.write("good.graph", start + kEdge)).graph.edgeCount(), 1u);
}
