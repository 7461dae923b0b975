#include <posidonia/apps/CGraphOptimizeApp.h>
#include <posidonia/apps/graph_replay.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/g2o_file.h>
#include <synthetic_graphs.h>

#include <nlohmann/json.hpp>
#include <set>

#include "apps_testing.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** A small survey from dead reckoning. */
TSyntheticGraph smallSurvey()
{
	TLawnMower options;
	options.nodes = 120;
	options.track = 20;
	options.tracks_a_block = 4;
	return lawnMower(options);
}

/** Its file, with ids that are not the nodes' places. */
std::string surveyFile(const CTempFolder& folder, const CPoseGraph& graph)
{
	std::vector<long long> ids;
	for (size_t i = 0; i < graph.nodeCount(); i++)
		ids.push_back(static_cast<long long>(100 + i));
	writeG2o(folder / "in.g2o", graph, ids);
	return folder / "in.g2o";
}

double meanError(const CPoseGraph& graph, const std::vector<Eigen::Isometry3d>& planted)
{
	double sum = 0;
	for (size_t i = 0; i < planted.size(); i++)
		sum += (graph.poses()[i].translation() - planted[i].translation()).norm();
	return sum / static_cast<double>(planted.size());
}

/** Three loops that join what lies far apart. */
std::set<int> addWrongLoops(CPoseGraph& graph)
{
	std::set<int> wrong;
	for (const auto& [from, to] : std::vector<std::pair<int, int>>{{3, 70}, {10, 90}, {25, 110}}) {
		TPoseEdge edge;
		edge.from = from;
		edge.to = to;
		edge.T_from_to.translation() << 0.5, 0.2, 0;
		edge.information = 1e5 * Matrix6d::Identity();
		wrong.insert(graph.addEdge(edge));
	}
	return wrong;
}

std::vector<std::vector<std::string>> csv(const std::string& path)
{
	std::vector<std::vector<std::string>> rows;
	std::istringstream in(fileBytes(path));
	for (std::string line; std::getline(in, line);) {
		rows.emplace_back();
		std::istringstream words(line);
		for (std::string word; std::getline(words, word, ',');)
			rows.back().push_back(word);
	}
	return rows;
}
}  // namespace

TEST(GraphOptimizeApp, FindsTheSurveyFromDeadReckoning)
{
	const CTempFolder folder;
	const TSyntheticGraph survey = smallSurvey();
	CGraphOptimizeApp app;
	runApp(app, {surveyFile(folder, survey.graph), "-o", folder / "out.g2o"});
	const auto& r = app.results();
	EXPECT_TRUE(r.solution.converged) << r.solution.status;
	EXPECT_EQ(app.exitStatus(), 0);
	EXPECT_EQ(r.nodes, 120u);
	EXPECT_EQ(r.edges, survey.graph.edgeCount());
	EXPECT_NEAR(r.chi2_before, chi2(survey.graph), 1e-9 * r.chi2_before);
	EXPECT_LT(r.chi2_after, 0.1 * r.chi2_before);
	EXPECT_NEAR(r.reduced_chi2, 1, 0.12) << "the noise is what the edges say";
	EXPECT_LT(meanError(app.graph(), survey.planted), 0.02);
	EXPECT_GT(meanError(survey.graph, survey.planted), 0.1);

	const TG2oGraph in = readG2o(folder / "in.g2o"), out = readG2o(folder / "out.g2o");
	EXPECT_EQ(in.file_ids, out.file_ids);
	ASSERT_EQ(in.graph.edgeCount(), out.graph.edgeCount());
	for (int k = 0; k < static_cast<int>(in.graph.edgeCount()); k++) {
		EXPECT_EQ(in.graph.edge(k).from, out.graph.edge(k).from) << "edge " << k;
		EXPECT_EQ(in.graph.edge(k).to, out.graph.edge(k).to) << "edge " << k;
		EXPECT_EQ(in.graph.edge(k).information, out.graph.edge(k).information) << "edge " << k;
	}
	EXPECT_NEAR(chi2(out.graph), r.chi2_after, 1e-6 * r.chi2_after);
}

TEST(GraphOptimizeApp, TwiceGivesTheSameBytes)
{
	const CTempFolder folder;
	const std::string in = surveyFile(folder, smallSurvey().graph);
	for (const std::string run : {"a", "b"}) {
		CGraphOptimizeApp app;
		runApp(
			app, {in, "-o", folder / (run + ".g2o"), "--robust", "cauchy", "--weights", folder / (run + ".w"),
				  "--marginals", folder / (run + ".m")});
	}
	for (const std::string file : {".g2o", ".w", ".m"}) {
		EXPECT_GT(fileBytes(folder / ("a" + file)).size(), 1000u) << file;
		EXPECT_EQ(fileBytes(folder / ("a" + file)), fileBytes(folder / ("b" + file))) << file;
	}
}

TEST(GraphOptimizeApp, StartsFromOdometryOrFromAnEdgeTree)
{
	const CTempFolder folder;
	const TSyntheticGraph survey = smallSurvey();
	CPoseGraph lost = survey.graph;
	for (int i = 1; i < 120; i++)
		lost.setPose(i, Eigen::Isometry3d::Identity());
	CGraphOptimizeApp app;
	runApp(app, {surveyFile(folder, lost), "--init", "odometry"});
	EXPECT_EQ(app.results().start, "odometry");
	EXPECT_NEAR(app.results().chi2_start, chi2(survey.graph), 1e-6 * chi2(survey.graph));
	EXPECT_LT(meanError(app.graph(), survey.planted), 0.02);

	CPoseGraph gap;	 // no odometry between 59 and 60
	for (int i = 0; i < 120; i++)
		gap.addNode(lost.pose(i), i == 0);
	for (const TPoseEdge& e : lost.edges())
		if (e.from != 59 || e.to != 60) gap.addEdge(e);
	runApp(app, {surveyFile(folder, gap), "--init", "odometry"});
	EXPECT_HOLDS(app.results().start, "tree of all edges");
	EXPECT_LT(meanError(app.graph(), survey.planted), 0.02);
}

TEST(GraphOptimizeApp, ChordalStartIsNearTheOptimumWhateverTheFileSays)
{
	const CTempFolder folder;
	const TSyntheticGraph survey = smallSurvey();
	CPoseGraph lost = survey.graph;
	for (int i = 1; i < 120; i++)
		lost.setPose(i, Eigen::Isometry3d::Identity());
	CGraphOptimizeApp app;
	runApp(app, {surveyFile(folder, lost), "--init", "chordal"});
	EXPECT_EQ(app.results().start, "chordal initialisation");
	EXPECT_LT(app.results().chi2_start, 0.1 * chi2(survey.graph)) << "better than the odometry's";
	EXPECT_LT(meanError(app.graph(), survey.planted), 0.02);
}

TEST(GraphOptimizeApp, RobustLossFindsTheWrongLoops)
{
	const CTempFolder folder;
	TSyntheticGraph survey = smallSurvey();
	const std::set<int> wrong = addWrongLoops(survey.graph);
	const std::string in = surveyFile(folder, survey.graph);
	CGraphOptimizeApp plain, robust;
	runApp(plain, {in});
	runApp(robust, {in, "--robust", "cauchy", "--robust-scale", "4.5", "--weights", folder / "w.csv"});
	EXPECT_GT(meanError(plain.graph(), survey.planted), 0.2);
	EXPECT_LT(meanError(robust.graph(), survey.planted), 0.02);
	const auto rows = csv(folder / "w.csv");
	ASSERT_EQ(rows.size(), survey.graph.edgeCount() + 1);
	EXPECT_EQ(rows[0], (std::vector<std::string>{"edge", "from", "to", "weight", "chi2"}));
	for (const int k : wrong) {
		const auto& row = rows[static_cast<size_t>(k) + 1];
		EXPECT_LT(std::stod(row[3]), 0.01) << "edge " << k;
		EXPECT_GT(std::stod(row[4]), 1e3) << "edge " << k;
		EXPECT_EQ(row[1], std::to_string(100 + survey.graph.edge(k).from));
	}
	for (size_t k = 0; k < survey.graph.edgeCount(); k++) {
		if (isLoop(survey.graph.edges()[k])) continue;
		EXPECT_EQ(rows[k + 1][3], "1") << "the odometry is trusted, edge " << k;
	}
	EXPECT_GE(robust.results().outliers, 3);
	EXPECT_LE(robust.results().outliers, 3 + static_cast<int>(survey.graph.edgeCount()) / 50);
}

TEST(GraphOptimizeApp, GncKeepsOrRejectsEachLoop)
{
	const CTempFolder folder;
	TSyntheticGraph survey = smallSurvey();
	CGraphOptimizeApp clean, gnc;
	runApp(clean, {surveyFile(folder, survey.graph)});
	const std::set<int> wrong = addWrongLoops(survey.graph);
	const std::string in = surveyFile(folder, survey.graph);
	runApp(gnc, {in, "--robust", "gnc", "--weights", folder / "w.csv", "--marginals", folder / "m.csv"});
	const auto& r = gnc.results();
	EXPECT_TRUE(r.solution.converged) << r.solution.status;
	EXPECT_GT(r.solution.rounds, 0);
	EXPECT_NEAR(meanError(gnc.graph(), survey.planted), meanError(clean.graph(), survey.planted), 1e-3);
	const auto rows = csv(folder / "w.csv");
	ASSERT_EQ(rows.size(), survey.graph.edgeCount() + 1);
	int rejected = 0;
	double kept = 0;
	for (size_t k = 0; k < survey.graph.edgeCount(); k++) {
		const std::string& weight = rows[k + 1][3];
		EXPECT_TRUE(weight == "0" || weight == "1") << "edge " << k << " " << weight;
		if (wrong.count(static_cast<int>(k))) {
			EXPECT_EQ(weight, "0") << "edge " << k;
		}
		rejected += weight == "0" ? 1 : 0;
		kept += weight == "1" ? std::stod(rows[k + 1][4]) : 0;
	}
	EXPECT_EQ(r.outliers, rejected);
	EXPECT_LE(rejected, 3 + static_cast<int>(survey.graph.edgeCount()) / 100) << "0.1 % expected";
	EXPECT_NEAR(r.chi2_kept, kept, 1e-9 * kept);
	EXPECT_GT(r.chi2_after, 10 * r.chi2_kept);
	EXPECT_NEAR(r.reduced_chi2, 1, 0.12);

	// The rejected edges do not count in the covariances either.
	CPoseGraph without;
	for (int i = 0; i < 120; i++)
		without.addNode(gnc.graph().pose(i), i == 0);
	for (size_t k = 0; k < survey.graph.edgeCount(); k++)
		if (rows[k + 1][3] == "1") without.addEdge(survey.graph.edge(static_cast<int>(k)));
	CSparseOptimizer optimizer;
	const Matrix6d expected = optimizer.marginals(without).covarianceOf(60);
	EXPECT_NEAR(std::stod(csv(folder / "m.csv")[60][1]), expected(0, 0), 1e-9 * expected(0, 0));
}

TEST(GraphOptimizeApp, OneAndTwoThreadsGiveTheSameBytes)
{
	const CTempFolder folder;
	TLawnMower options;
	options.nodes = 1500;  // enough for subtrees of their own
	TSyntheticGraph survey = lawnMower(options);
	addWrongLoops(survey.graph);
	const std::string in = surveyFile(folder, survey.graph);
	for (const std::string kernel : {"none", "gnc"}) {
		for (const std::string threads : {"1", "2"}) {
			CGraphOptimizeApp app;
			runApp(
				app, {in, "-o", folder / (threads + ".g2o"), "--robust", kernel, "--threads", threads,
					  "--weights", folder / (threads + ".w"), "--marginals", folder / (threads + ".m")});
			EXPECT_EQ(app.params.optimizer.threads, std::stoi(threads));
		}
		for (const std::string file : {".g2o", ".w", ".m"}) {
			EXPECT_GT(fileBytes(folder / ("1" + file)).size(), 10000u) << kernel << file;
			EXPECT_EQ(fileBytes(folder / ("1" + file)), fileBytes(folder / ("2" + file))) << kernel << file;
		}
	}
}

TEST(GraphOptimizeApp, MarginalsAreThoseOfTheDenseInverse)
{
	const CTempFolder folder;
	CGraphOptimizeApp app;
	runApp(app, {surveyFile(folder, smallSurvey().graph), "--marginals", folder / "m.csv"});
	const auto rows = csv(folder / "m.csv");
	ASSERT_EQ(rows.size(), 120u) << "a header and the free nodes";
	ASSERT_EQ(rows[0].size(), 25u);
	CMultifrontalCholesky cholesky;
	CNormalEquations system;
	system.followStructure(app.graph(), cholesky);
	system.linearize(app.graph());
	const Eigen::MatrixXd dense = system.H().toDense().inverse();
	for (const int node : {1, 60, 119}) {
		const auto& row = rows[static_cast<size_t>(node)];
		EXPECT_EQ(row[0], std::to_string(100 + node));
		const Matrix6d expected = dense.block<6, 6>(6 * system.columnOf(node), 6 * system.columnOf(node));
		for (int r = 0, at = 1; r < 6; r++)
			for (int c = 0; c <= r; c++, at++)
				EXPECT_NEAR(std::stod(row[static_cast<size_t>(at)]), expected(r, c), 1e-8 * expected.norm())
					<< "node " << node << " entry " << r << ", " << c;
		const Eigen::Matrix3d R = app.graph().pose(node).linear();
		const Eigen::Matrix3d in_map = R * expected.topLeftCorner<3, 3>() * R.transpose();
		for (int k = 0; k < 3; k++)
			EXPECT_NEAR(
				std::stod(row[static_cast<size_t>(22 + k)]), std::sqrt(in_map(k, k)),
				1e-6 * std::sqrt(in_map(k, k)))
				<< "node " << node << " axis " << k;
	}
}

TEST(GraphOptimizeApp, IncrementalEndsAtTheBatchOptimum)
{
	const CTempFolder folder;
	const std::string in = surveyFile(folder, smallSurvey().graph);
	for (const std::string kernel : {"none", "cauchy", "dcs"}) {
		CGraphOptimizeApp batch, incremental;
		runApp(batch, {in, "--robust", kernel, "--weights", folder / "batch.csv"});
		runApp(
			incremental,
			{in, "--robust", kernel, "--solver", "incremental", "--weights", folder / "incremental.csv"});
		EXPECT_TRUE(incremental.results().solution.converged) << kernel;
		EXPECT_NEAR(
			incremental.results().chi2_after, batch.results().chi2_after, 1e-4 * batch.results().chi2_after)
			<< kernel;
		const auto expected = csv(folder / "batch.csv"), rows = csv(folder / "incremental.csv");
		ASSERT_EQ(rows.size(), expected.size()) << kernel;
		for (size_t k = 1; k < rows.size(); k++)
			EXPECT_NEAR(std::stod(rows[k][3]), std::stod(expected[k][3]), 0.01)
				<< kernel << " edge " << k - 1;
	}
}

TEST(GraphOptimizeApp, LevMarqIsMrptsAndLowersChi2)
{
	const CTempFolder folder;
	const TSyntheticGraph survey = smallSurvey();
	const std::string in = surveyFile(folder, survey.graph);
	CGraphOptimizeApp batch, mrpt;
	runApp(batch, {in});
	runApp(mrpt, {in, "--solver", "levmarq"});
	EXPECT_GE(mrpt.results().chi2_after, batch.results().chi2_after * (1 - 1e-9));
	EXPECT_LT(mrpt.results().chi2_after, 0.5 * mrpt.results().chi2_before);
	EXPECT_GE(mrpt.results().solution.iterations, 1);
}

TEST(GraphOptimizeApp, TooFewIterationsAreSaidAndTheBestPosesAreWritten)
{
	const CTempFolder folder;
	const std::string in = surveyFile(folder, smallSurvey().graph);
	CGraphOptimizeApp app;
	::testing::internal::CaptureStderr();
	runApp(app, {in, "-o", folder / "out.g2o", "--set", "GraphOptimizer.max_iterations=1"});
	const std::string said = ::testing::internal::GetCapturedStderr();
	EXPECT_HOLDS(said, "warning: ");
	EXPECT_HOLDS(said, "not converged: max iterations after 1 iterations");
	EXPECT_EQ(app.exitStatus(), 3);
	EXPECT_FALSE(app.results().solution.converged);
	EXPECT_LT(chi2(readG2o(folder / "out.g2o").graph), app.results().chi2_before);
}

TEST(GraphOptimizeApp, JsonHasTheNumbers)
{
	const CTempFolder folder;
	const std::string in = surveyFile(folder, smallSurvey().graph);
	CGraphOptimizeApp app;
	::testing::internal::CaptureStdout();
	runApp(app, {in, "--json", "--init", "odometry", "--robust", "huber"});
	const auto json = nlohmann::json::parse(::testing::internal::GetCapturedStdout());
	const auto& r = app.results();
	EXPECT_EQ(json.at("chi2_before").get<double>(), r.chi2_before);
	EXPECT_EQ(json.at("chi2_start").get<double>(), r.chi2_start);
	EXPECT_EQ(json.at("chi2_after").get<double>(), r.chi2_after);
	EXPECT_EQ(json.at("reduced_chi2").get<double>(), r.reduced_chi2);
	EXPECT_EQ(json.at("iterations").get<int>(), r.solution.iterations);
	EXPECT_EQ(json.at("status").get<std::string>(), "converged");
	EXPECT_TRUE(json.at("converged").get<bool>());
	EXPECT_EQ(json.at("nodes").get<int>(), 120);
	EXPECT_EQ(json.at("edges").get<size_t>(), r.edges);
	EXPECT_EQ(json.at("solver").get<std::string>(), "batch");
	EXPECT_EQ(json.at("init").get<std::string>(), "odometry");
	EXPECT_EQ(json.at("robust").get<std::string>(), "huber");
	EXPECT_EQ(json.at("outliers").get<int>(), r.outliers);
	EXPECT_GT(json.at("cpu_s").get<double>(), 0);
	EXPECT_GT(json.at("wall_s").get<double>(), 0);
	EXPECT_GT(json.at("peak_memory_mb").get<double>(), 1);
	const auto& stages = json.at("stages");
	for (const char* stage : {"read", "initialise", "optimise", "marginals", "write"})
		EXPECT_GE(stages.at(stage).at("cpu_s").get<double>(), 0) << stage;
	EXPECT_NEAR(
		json.at("cpu_s").get<double>(),
		stages.at("initialise").at("cpu_s").get<double>() + stages.at("optimise").at("cpu_s").get<double>(),
		1e-9);
}

TEST(GraphOptimizeApp, ReadsMrptsGraphAndSaysWhatItLacks)
{
	const CTempFolder folder;
	const std::string in = folder.write(
		"in.graph",
		"VERTEX3 0 0 0 0 0 0 0\nVERTEX3 1 1.1 0 0 0 0 0.1\nVERTEX3 2 2 0 0 0 0 0\n"
		"EDGE3 0 1 1 0 0 0 0 0\nEDGE3 1 2 1 0 0 0 0 0\nEDGE3 0 2 2.3 0 0 0 0 0\n");
	CGraphOptimizeApp app;
	::testing::internal::CaptureStderr();
	runApp(app, {in, "-o", folder / "out.g2o"});
	EXPECT_HOLDS(::testing::internal::GetCapturedStderr(), "in.graph: 3 edges have no information");
	// 0.3 m of misclosure, shared by three equal edges
	const CPoseGraph graph = readG2o(folder / "out.g2o").graph;
	EXPECT_NEAR(graph.pose(1).translation().x(), 1.1, 1e-7);
	EXPECT_NEAR(graph.pose(2).translation().x(), 2.2, 1e-7);
	EXPECT_NEAR(app.results().chi2_after, 3 * 0.01, 1e-9);
}

TEST(GraphOptimizeApp, FlagsWithoutEffectAreRefused)
{
	const CTempFolder folder;
	const std::string in = surveyFile(folder, smallSurvey().graph);
	const auto refusal = [&](std::vector<std::string> args) {
		CGraphOptimizeApp app;
		return errorOf<CUsageError>([&] { runApp(app, args); });
	};
	EXPECT_HOLDS(refusal({}), "IN.g2o: is missing");
	EXPECT_HOLDS(refusal({in, "--robust-scale", "3"}), "--robust-scale: has no effect without --robust");
	EXPECT_HOLDS(refusal({in, "--robust", "huber", "--robust-scale", "0"}), "--robust-scale: must be > 0");
	EXPECT_HOLDS(refusal({in, "--robust", "huber", "--solver", "levmarq"}), "no robust losses");
	EXPECT_HOLDS(
		refusal({in, "--robust", "gnc", "--robust-scale", "3"}),
		"--robust-scale: has no effect with --robust gnc");
	EXPECT_HOLDS(refusal({in, "--robust", "gnc", "--solver", "incremental"}), "needs the whole graph");
	EXPECT_HOLDS(refusal({in, "--threads", "2", "--solver", "levmarq"}), "has one only");
	for (const std::string threads : {"0", "-1", "65"})
		EXPECT_HOLDS(refusal({in, "--threads", threads}), "--threads " + threads + ": is not 1 to 64");
	EXPECT_HOLDS(refusal({in, "--init", "odometry", "--solver", "incremental"}), "--init: has no effect");
	EXPECT_HOLDS(refusal({in, "--solver", "magic"}), "solver");
	EXPECT_HOLDS(refusal({in, "-o", in}), "is the input itself");
	EXPECT_HOLDS(refusal({in, "-o", folder / "out.graph"}), "name it .g2o");
}

TEST(GraphReplay, PlaysEveryEdgeOnceInOrderOfArrival)
{
	const CPoseGraph whole = smallSurvey().graph;
	CGraphReplay replay(whole);
	CPoseGraph growing;
	int closings = 0;
	while (!replay.done()) {
		const bool closed = replay.addNext(growing);
		const int node = static_cast<int>(growing.nodeCount()) - 1;
		bool expected = false;
		for (const TPoseEdge& e : whole.edges())
			expected |= e.to == node && e.from < node - 1;
		EXPECT_EQ(closed, expected) << "node " << node;
		closings += closed ? 1 : 0;
	}
	EXPECT_EQ(closings, 118);
	EXPECT_EQ(growing.edgeCount(), whole.edgeCount());
	EXPECT_EQ(std::set<int>(replay.edgeOrder().begin(), replay.edgeOrder().end()).size(), whole.edgeCount());
	for (int i = 0; i < 120; i++)  // nothing was optimised: dead reckoning, as the whole's own poses
		EXPECT_LT((growing.pose(i).matrix() - whole.pose(i).matrix()).norm(), 1e-9) << "node " << i;

	CPoseGraph late;  // node 1 hangs on a newer node only
	for (int i = 0; i < 3; i++)
		late.addNode(Eigen::Isometry3d::Identity(), i == 0);
	TPoseEdge edge;
	edge.from = 0, edge.to = 2;
	late.addEdge(edge);
	edge.from = 1;
	late.addEdge(edge);
	EXPECT_HOLDS(errorOf<CError>([&] { CGraphReplay refused(late); }), "node 1: is neither fixed");
}
