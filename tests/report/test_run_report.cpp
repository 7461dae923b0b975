#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/report/floor_mosaic.h>
#include <posidonia/report/run_pictures.h>

#include <set>

#include "run_testing.h"

using namespace posidonia;
using namespace posidonia::testing;

TEST(RunReport, HoldsWhatTheRunDid)
{
	const CTempFolder folder;
	const auto page = jsonOf(swimEast(folder / "run"));
	EXPECT_EQ(page.at("title"), "swim <east>");
	EXPECT_EQ(page.at("start_utc"), "1970-01-01T00:16:40Z");
	EXPECT_EQ(page.at("loops").at("from").size(), 11u);
	EXPECT_NEAR(page.at("loops").at("residual_m")[4].get<double>(), 0.005, 1e-6);
	EXPECT_NEAR(page.at("loops").at("error_m")[4].get<double>(), 0.005, 1e-6);
	EXPECT_EQ(page.at("loops").at("points")[0], "ECowVVCA/f0=")
		<< "(10, 20) (30, 40) (50, 60) (159, 119) in bytes";
	EXPECT_EQ(page.at("key_frames").size(), 12u);
	EXPECT_EQ(page.at("nodes").at("altitude")[3], 2.5);
	EXPECT_EQ(page.at("camera").at("width"), 160);
	for (const auto& curve : page.at("errors"))
		for (const auto& error : curve.at("error"))
			EXPECT_NEAR(error.get<double>(), 0.01, 1e-6) << curve.at("name");
	EXPECT_NEAR(page.at("consistency").at("anees").get<double>(), 1.0 / 3, 1e-3) << "1 sigma to the north";
	EXPECT_TRUE(page.at("notes").empty());
}

TEST(RunReport, WithoutTruthAndPicturesItSaysLess)
{
	const CTempFolder folder;
	TRunData run = swimEast(folder / "run");
	run.trajectories.erase("truth");
	run.camera.reset();
	for (TNodeRow& node : run.nodes)
		node.picture.clear();
	const auto page = jsonOf(run);
	EXPECT_TRUE(page.at("errors").empty());
	EXPECT_TRUE(page.at("consistency").is_null());
	EXPECT_TRUE(page.at("floor").is_null());
	EXPECT_TRUE(page.at("key_frames").empty());
	EXPECT_TRUE(page.at("loops").at("error_m")[0].is_null());
}

TEST(RunReport, ALongRunIsThinnedAndSaysSo)
{
	const CTempFolder folder;
	const TRunData run = swimEast(folder / "run", 60);
	TReportLimits limits;
	limits.poses = 20, limits.loops = 10, limits.all_key_frames = 30, limits.worst_loops = 3,
	limits.random_loops = 2;
	const auto page = jsonOf(run, limits);
	EXPECT_EQ(page.at("loops").at("to").size(), 10u);
	EXPECT_EQ(page.at("loops").at("to").back(), 59) << "the one with the largest residual";
	std::set<int> embedded;
	for (const auto& frame : page.at("key_frames"))
		if (!frame.at("jpeg").is_null()) embedded.insert(frame.at("node").get<int>());
	EXPECT_EQ(embedded.size(), 6u) << "node 0 and the other ends of five loops";
	EXPECT_TRUE(embedded.count(59) && embedded.count(58) && embedded.count(57));
	EXPECT_EQ(page.at("key_frames").size(), 60u) << "the others keep their links";
	for (const auto& t : page.at("trajectories"))
		EXPECT_EQ(t.at("t").size(), t.at("name") == "nodes" ? 60u : 20u) << t.at("name");
	EXPECT_EQ(page.at("notes").size(), 3u) << page.at("notes").dump();
}

TEST(RunReport, ThePageCannotBeBrokenByItsData)
{
	const std::string page = reportPage("a <b> & c", R"({"log":"</script><!-- "})");
	EXPECT_EQ(page.find("</script><!--"), std::string::npos);
	EXPECT_NE(page.find("\\u003c/script>\\u003c!-- "), std::string::npos);
	EXPECT_NE(page.find("<title>a &lt;b&gt; &amp; c"), std::string::npos) << page.substr(0, 300);
	EXPECT_EQ(page.find("__RUN_JSON__"), std::string::npos);
}

/** A white spot in the middle of each picture lies under the vehicle. */
TEST(FloorMosaic, SpotsLieWhereTheVehicleWas)
{
	const CTempFolder folder;
	const TRunData run = swimEast(folder / "run");
	const auto mosaic = floorMosaic(run);
	ASSERT_TRUE(mosaic);
	EXPECT_EQ(mosaic->pictures, 12);
	EXPECT_NEAR(mosaic->depth, 6, 1e-9);
	EXPECT_EQ(mosaic->seen(0, 0), 0) << "a corner beyond the pictures";
	EXPECT_EQ(mosaic->seen(mosaic->seen.rows / 2, mosaic->seen.cols / 2), 255);
	const double north = (mosaic->north_max - mosaic->north_min) / mosaic->image.rows,
				 east = (mosaic->east_max - mosaic->east_min) / mosaic->image.cols;
	const auto brightness = [&](double n, double e) {
		return int(mosaic->image(int((mosaic->north_max - n) / north), int((e - mosaic->east_min) / east)));
	};
	for (const TNodeRow& node : run.nodes) {
		const Eigen::Vector3d p = node.T_map_body.translation();
		EXPECT_GT(brightness(p.x(), p.y()), 150) << "node " << node.node;
		EXPECT_LT(brightness(p.x(), p.y() + 0.25), 150) << "between node " << node.node << " and the next";
		EXPECT_LT(brightness(p.x() + 0.3, p.y()), 150) << "north of node " << node.node;
	}
}

TEST(RunPictures, EveryPlotThatTheDataAllow)
{
	const CTempFolder folder;
	TRunData run = swimEast(folder / "run");
	writeRunPictures(run, folder / "all");
	for (const char* name : {"trajectories.svg", "error.svg", "node-errors.svg", "nees.svg"})
		EXPECT_HOLDS(fileBytes(folder / "all/" + name), "</svg>") << name;
	run.trajectories.erase("truth");
	writeRunPictures(run, folder / "blind");
	EXPECT_TRUE(std::filesystem::exists(folder / "blind/trajectories.svg"));
	EXPECT_FALSE(std::filesystem::exists(folder / "blind/error.svg"));
}

TEST(RunData, AFolderThatIsNoRunIsNamed)
{
	const CTempFolder folder;
	try {
		readRun(folder / "nothing");
		FAIL() << "it was read";
	}
	catch (const CError& problem) {
		EXPECT_HOLDS(std::string(problem.what()), "run.json");
	}
}
