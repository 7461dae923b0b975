#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CTexturedPlane.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/report/exports.h>

#include <sstream>

#include "run_testing.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** The first and last positions of the run's nodes, from geographic coordinates. */
void expectEnds(const TRunData& run, const std::vector<TGeodetic>& way)
{
	const auto& nodes = run.trajectory("nodes");
	ASSERT_EQ(way.size(), nodes.size());
	for (const size_t k : {size_t(0), way.size() - 1}) {
		const Eigen::Vector3d ned = nedFromGeodetic(way[k], run.info.datum);
		EXPECT_LT((ned - nodes[k].T.translation()).norm(), 2e-3) << ned.transpose();
	}
}
}  // namespace

TEST(Exports, GeoJsonReadsBack)
{
	const CTempFolder folder;
	const TRunData run = swimEast(folder / "run");
	const auto json = nlohmann::json::parse(geoJsonOf(run));
	EXPECT_EQ(json.at("type"), "FeatureCollection");
	ASSERT_EQ(json.at("features").size(), 2u) << "SLAM and truth";
	std::vector<TGeodetic> way;
	for (const auto& c : json.at("features")[0].at("geometry").at("coordinates"))
		way.push_back({c[1].get<double>(), c[0].get<double>(), c[2].get<double>()});
	expectEnds(run, way);
}

TEST(Exports, KmlReadsBack)
{
	const CTempFolder folder;
	const TRunData run = swimEast(folder / "run");
	const std::string kml = kmlOf(run);
	EXPECT_HOLDS(kml, "swim &lt;east&gt;");
	const size_t from = kml.find("<coordinates>") + 13, to = kml.find("</coordinates>");
	std::istringstream lines(kml.substr(from, to - from));
	std::vector<TGeodetic> way;
	char comma;
	for (TGeodetic g; lines >> g.longitude >> comma >> g.latitude >> comma >> g.height;)
		way.push_back(g);
	expectEnds(run, way);
}

TEST(Exports, PhotosSayWhereTheCameraWas)
{
	const CTempFolder folder;
	TRunData run = swimEast(folder / "run");
	run.nodes[1].picture.clear();
	std::istringstream csv(photoPositionsCsv(run));
	std::string line;
	std::getline(csv, line);
	EXPECT_EQ(line, "image,lat,lon,depth,roll,pitch,yaw");
	std::getline(csv, line);
	EXPECT_EQ(line.substr(0, 12), "loops/0.jpg,");
	EXPECT_EQ(line.substr(line.size() - 25), ",3.500,0.000,0.000,90.000") << line;
	int rows = 1;
	while (std::getline(csv, line))
		rows++;
	EXPECT_EQ(rows, 11) << "a node without a picture has no row";
}

TEST(Exports, MrptReadsTheSimpleMap)
{
	const CTempFolder folder;
	const TRunData run = swimEast(folder / "run");
	writeExports(run, folder / "run/exports", floorMosaic(run));
	mrpt::maps::CSimpleMap map;
	ASSERT_TRUE(map.loadFromFile(folder / "run/exports/map.simplemap"));
	ASSERT_EQ(map.size(), run.nodes.size());
	mrpt::poses::CPose3DPDF::Ptr pose;
	mrpt::obs::CSensoryFrame::Ptr frame;
	map.get(5, pose, frame);
	const auto expected = run.nodes[5].T_map_body;
	EXPECT_LT((fromMrpt(pose->getMeanVal()).matrix() - expected.matrix()).norm(), 1e-6);
	const auto picture = frame->getObservationByClass<mrpt::obs::CObservationImage>();
	ASSERT_TRUE(picture);
	EXPECT_EQ(picture->image.getExternalStorageFile(), "../loops/5.jpg");
}

TEST(Exports, MrptReadsTheScene)
{
	const CTempFolder folder;
	const TRunData run = swimEast(folder / "run");
	writeScene(run, folder / "scene.3Dscene", floorMosaic(run));
	mrpt::opengl::COpenGLScene scene;
	ASSERT_TRUE(scene.loadFromFile(folder / "scene.3Dscene"));
	const auto root = scene.getByClass<mrpt::opengl::CSetOfObjects>();
	ASSERT_TRUE(root);
	EXPECT_NEAR(std::abs(root->getPoseRoll()), 180, 1e-4) << "depth points downwards";
	const auto named = [&](const char* name) {
		return std::dynamic_pointer_cast<mrpt::opengl::CSetOfLines>(root->getByName(name));
	};
	for (const char* name : {"ground truth", "odometry", "SLAM, final nodes"}) {
		ASSERT_TRUE(named(name)) << name;
		EXPECT_EQ(named(name)->size(), run.nodes.size() - 1) << name;
	}
	EXPECT_EQ(named("loop closings")->size(), run.loops.size());
	EXPECT_TRUE(root->getByClass<mrpt::opengl::CTexturedPlane>()) << "the floor";
}
