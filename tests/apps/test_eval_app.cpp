#include <posidonia/apps/CEvalApp.h>
#include <posidonia/geometry/se3.h>

#include <cmath>

#include "apps_testing.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** A bent way of 30 m, a pose a metre. */
TTrajectory bentWay()
{
	TTrajectory t;
	for (int i = 0; i <= 30; i++) {
		TStampedPose pose;
		pose.stamp = 1000 + i;
		pose.T.translation() << i, 3 * std::sin(0.2 * i), 2 + 0.1 * i;
		pose.T.linear() = Eigen::AngleAxisd(0.05 * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();
		t.push_back(pose);
	}
	return t;
}

/** Its positions off by e(i), in map axes. */
TTrajectory offBy(TTrajectory t, const std::function<Eigen::Vector3d(int)>& e)
{
	for (size_t i = 0; i < t.size(); i++)
		t[i].T.translation() += e(static_cast<int>(i));
	return t;
}

Eigen::Vector3d someError(int i)
{
	return {0.01 * i, 0.3 - 0.02 * i, 0.005 * i * i};
}

/** What is printed while it lives; ends the capture in an error too. */
class CCapturedOutput
{
   public:
	CCapturedOutput() { ::testing::internal::CaptureStdout(); }
	~CCapturedOutput()
	{
		if (!m_taken) ::testing::internal::GetCapturedStdout();
	}
	CCapturedOutput(const CCapturedOutput&) = delete;
	CCapturedOutput& operator=(const CCapturedOutput&) = delete;
	std::string text()
	{
		m_taken = true;
		return ::testing::internal::GetCapturedStdout();
	}

   private:
	bool m_taken{false};
};

TMetrics eval(const std::vector<std::string>& args)
{
	const CCapturedOutput captured;
	CEvalApp app;
	runApp(app, args);
	return app.results().metrics;
}

std::string printed(const std::vector<std::string>& args)
{
	CCapturedOutput captured;
	CEvalApp app;
	runApp(app, args);
	return captured.text();
}
}  // namespace

TEST(EvalApp, NumbersAreThoseOfTheFormulas)
{
	const CTempFolder folder;
	const TTrajectory truth = bentWay(), estimate = offBy(truth, someError);
	writeTum(folder / "truth.tum", truth);
	writeTum(folder / "dive.tum", estimate);
	const TMetrics rows = eval({"-i", folder / "dive.tum", "-g", folder / "truth.tum"});

	double sum = 0, squares = 0, worst = 0, length = 0, origin = 0;
	for (int i = 0; i <= 30; i++) {
		const double e = someError(i).norm();
		sum += e;
		squares += e * e;
		worst = std::max(worst, e);
		origin +=
			(someError(i) - someError(0)).norm();  // attitudes are right: the origin's alignment is a shift
		if (i)
			length += (estimate[static_cast<size_t>(i)].T.translation() -
					   estimate[static_cast<size_t>(i) - 1].T.translation())
						  .norm();
	}
	EXPECT_NEAR(metric(rows, "dive.ate.unaligned.mean"), sum / 31, 1e-7);
	EXPECT_NEAR(metric(rows, "dive.ate.unaligned.rmse"), std::sqrt(squares / 31), 1e-7);
	EXPECT_NEAR(metric(rows, "dive.ate.unaligned.sse"), squares, 1e-6);
	EXPECT_NEAR(metric(rows, "dive.ate.unaligned.max"), worst, 1e-7);
	EXPECT_NEAR(metric(rows, "dive.ate.origin.mean"), origin / 31, 1e-7);
	EXPECT_NEAR(metric(rows, "dive.end_error.unaligned"), someError(30).norm(), 1e-7);
	EXPECT_NEAR(metric(rows, "dive.length"), length, 1e-6);
	EXPECT_NEAR(metric(rows, "dive.ate.unaligned.rotation.mean"), 0, 1e-4);
}

TEST(EvalApp, RelativeErrorOfAConstantScaleIsThatScale)
{
	const CTempFolder folder;
	TTrajectory truth;
	for (int i = 0; i <= 40; i++) {
		truth.push_back({1000.0 + i, Eigen::Isometry3d::Identity()});
		truth.back().T.translation().x() = i;
	}
	writeTum(folder / "truth.tum", truth);
	writeTum(folder / "dive.tum", offBy(truth, [](int i) { return Eigen::Vector3d(0.02 * i, 0, 0); }));
	const TMetrics rows = eval({"-i", folder / "dive.tum", "-g", folder / "truth.tum"});
	EXPECT_NEAR(metric(rows, "dive.rpe.mean"), 0.2, 1e-6) << "2 % of 10 m";
	EXPECT_NEAR(metric(rows, "dive.rpe.drift.mean"), 2, 1e-5);
	const TMetrics five =
		eval({"-i", folder / "dive.tum", "-g", folder / "truth.tum", "--set", "Evaluation.rpe_delta=5"});
	EXPECT_NEAR(metric(five, "dive.rpe.mean"), 0.1, 1e-6);
}

TEST(EvalApp, FormatsAreToldApart)
{
	const CTempFolder folder;
	const TTrajectory truth = bentWay(), estimate = offBy(truth, someError);
	writeTum(folder / "truth.tum", truth);
	writeTum(folder / "dive.tum", estimate);
	writeEuroc(folder / "dive.csv", estimate);
	TTrajectory indexed_truth = truth;
	for (size_t i = 0; i < truth.size(); i++)
		indexed_truth[i].stamp = static_cast<double>(i);
	writeTum(folder / "indexed.tum", indexed_truth);
	writeKitti(folder / "dive.kitti", estimate);
	const double mean =
		metric(eval({"-i", folder / "dive.tum", "-g", folder / "truth.tum"}), "dive.ate.se3.mean");
	EXPECT_GT(mean, 0.01);
	EXPECT_NEAR(
		metric(eval({"-i", folder / "dive.csv", "-g", folder / "truth.tum"}), "dive.ate.se3.mean"), mean,
		1e-6);
	EXPECT_NEAR(
		metric(
			eval(
				{"-i", folder / "dive.kitti", "-g", folder / "indexed.tum", "--set",
				 "Evaluation.association_max_gap=1.5"}),
			"dive.ate.se3.mean"),
		mean, 1e-6);
}

TEST(EvalApp, TableShowsTheAlignmentsAskedFor)
{
	const CTempFolder folder;
	writeTum(folder / "truth.tum", bentWay());
	writeTum(folder / "dive.tum", offBy(bentWay(), someError));
	const std::vector<std::string> args{"-i", folder / "dive.tum", "-g", folder / "truth.tum"};
	const std::string all = printed(args);
	for (const char* part :
		 {"unaligned", "origin aligned", "yaw+position aligned", "SE(3) aligned", "relative error", "length",
		  "drift [%]"})
		EXPECT_HOLDS(all, part);
	auto only = args;
	only.insert(only.end(), {"--align", "yaw_position"});
	EXPECT_HOLDS(printed(only), "yaw+position aligned");
	EXPECT_EQ(printed(only).find("unaligned"), std::string::npos);
	auto bad = args;
	bad.insert(bad.end(), {"--align", "yaw"});
	EXPECT_HOLDS(errorOf<CUsageError>([&] { eval(bad); }), "--align yaw: is no alignment");
}

TEST(EvalApp, WritesFilesAndJson)
{
	const CTempFolder folder;
	writeTum(folder / "truth.tum", bentWay());
	writeTum(folder / "dive.tum", offBy(bentWay(), someError));
	writeTum(folder / "worse.tum", offBy(bentWay(), [](int) { return Eigen::Vector3d(2, 0, 0); }));
	const std::string json = printed(
		{"-i", folder / "dive.tum", "-i", folder / "worse.tum", "-g", folder / "truth.tum", "-o",
		 folder / "out", "--json"});
	EXPECT_EQ(json, fileBytes(folder / "out/metrics.json"));
	const TMetrics rows = readMetricsJson(folder / "out/metrics.json");
	EXPECT_NEAR(metric(rows, "worse.tum.worse.ate.unaligned.mean"), 2, 1e-6);
	EXPECT_NEAR(metric(rows, "worse.tum.worse.ate.origin.mean"), 0, 1e-6);
	EXPECT_GT(metric(rows, "dive.tum.dive.ate.unaligned.mean"), 0.1);
	EXPECT_HOLDS(fileBytes(folder / "out/metrics.csv"), "worse.tum.worse.ate.unaligned.mean,m,2");
}

TEST(EvalApp, RunFolderScoresAsTheRunDid)
{
	const auto& run = slamRun().results();
	const TMetrics rows = eval({"-i", run.folder, "-g", survey().truth});
	size_t compared = 0;
	for (const auto& row : run.metrics) {
		if (row.what.compare(0, 6, "graph.") == 0) continue;
		EXPECT_NEAR(metric(rows, row.what), row.value, 1e-6 * std::max(1.0, std::abs(row.value))) << row.what;
		compared++;
	}
	EXPECT_EQ(compared, rows.size());
	EXPECT_GT(metric(rows, "loops.accepted"), 0);
}

TEST(EvalApp, RefusesToOverwriteTheRun)
{
	const auto& run = slamRun().results();
	const std::string before = fileBytes(run.folder + "/metrics.json");
	EXPECT_HOLDS(
		errorOf<CUsageError>([&] {
			eval({"-i", run.folder, "-g", survey().truth, "-o", run.folder + "/"});
		}),
		"is the run itself");
	EXPECT_EQ(before, fileBytes(run.folder + "/metrics.json"));
}

TEST(EvalApp, SummaryIsMedianAndWorst)
{
	const CTempFolder folder;
	const double errors[] = {0.5, 0.1, 0.2}, recalls[] = {0.9, 0.7, 0.8}, falses[] = {0, 2, 0},
				 loops[] = {50, 30, 40};
	std::vector<std::string> args{"--summary"};
	for (int i = 0; i < 3; i++) {
		const std::string run = folder / ("seed" + std::to_string(i));
		std::filesystem::create_directories(run);
		TMetrics rows{
			{"nodes.ate.unaligned.mean", "m", errors[i]},
			{"loops.accepted", "", loops[i]},
			{"loops.false", "", falses[i]},
			{"loops.recall_of_all", "", recalls[i]}};
		if (i > 0) rows.push_back({"loops.recall_of_tried", "", 1});
		writeMetricsJson(run + "/metrics.json", rows);
		args.insert(args.end(), {"-i", run});
	}
	const TMetrics rows = eval(args);
	EXPECT_DOUBLE_EQ(metric(rows, "nodes.ate.unaligned.mean.median"), 0.2);
	EXPECT_DOUBLE_EQ(metric(rows, "nodes.ate.unaligned.mean.worst"), 0.5);
	EXPECT_DOUBLE_EQ(metric(rows, "loops.recall_of_all.median"), 0.8);
	EXPECT_DOUBLE_EQ(metric(rows, "loops.recall_of_all.worst"), 0.7);
	EXPECT_DOUBLE_EQ(metric(rows, "loops.false.worst"), 2);
	EXPECT_DOUBLE_EQ(metric(rows, "loops.false.median"), 0);
	EXPECT_DOUBLE_EQ(metric(rows, "loops.accepted.worst"), 30);
	EXPECT_EQ(rows.size(), 8u) << "the recall that one run lacks is left out";
	const std::string text = printed(args);
	EXPECT_HOLDS(text, "3 runs");
	EXPECT_HOLDS(text, "note: loops.recall_of_tried is left out: no value in " + folder / "seed0");
}

TEST(EvalApp, BadInputsAreNamed)
{
	const CTempFolder folder;
	std::filesystem::create_directories(folder / "empty");
	writeTum(folder / "truth.tum", bentWay());
	EXPECT_HOLDS(
		errorOf<CError>([&] {
			eval({"-i", folder / "empty", "-g", folder / "truth.tum"});
		}),
		"empty: holds none of");
	EXPECT_HOLDS(
		errorOf<CError>([&] {
			eval({"-i", folder / "no.tum", "-g", folder / "truth.tum"});
		}),
		"no.tum: no such");
	EXPECT_HOLDS(
		errorOf<CError>([&] {
			eval({"-i", folder / "truth.tum", "-g", folder / "no.tum"});
		}),
		"no.tum: no such");
	EXPECT_HOLDS(
		errorOf<CError>([&] {
			eval({"--summary", "-i", folder / "empty"});
		}),
		"metrics.json: no such file");
	EXPECT_HOLDS(
		errorOf<CUsageError>([&] {
			eval({"-i", folder / "truth.tum"});
		}),
		"-g/--ground-truth: is missing");
	EXPECT_HOLDS(errorOf<CUsageError>([&] { eval({"-g", folder / "truth.tum"}); }), "-i/--input: is missing");
	folder.write("bad.tum", "1000 0 0 0 0 0 0 1\n1001 0 0\n");
	EXPECT_HOLDS(
		errorOf<CError>([&] {
			eval({"-i", folder / "bad.tum", "-g", folder / "truth.tum"});
		}),
		"bad.tum:2");
}
