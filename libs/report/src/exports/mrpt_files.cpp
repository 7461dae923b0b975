#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CTexturedPlane.h>
#include <mrpt/opengl/stock_objects.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/obs/observations.h>
#include <posidonia/report/exports.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <ostream>

namespace fs = std::filesystem;

namespace posidonia
{
using Eigen::Vector3d;
using mrpt::img::TColor;

namespace
{
/** Lets MRPT write `path`.part, and gives it its name when it is whole. */
template <class F>
void savedWhole(const std::string& path, F&& save)
{
	const std::string part = path + ".part";
	if (!save(part)) throw CError(path, "can't be written", "is the folder writable and the disk not full?");
	fs::rename(part, path);
}

// ------------------------------------------------------------------------------------------- map.simplemap

mrpt::obs::CObservationImage::Ptr pictureOf(const TNodeRow& node, const TRunData& run, const fs::path& folder)
{
	auto picture = mrpt::obs::CObservationImage::Create();
	picture->sensorLabel = "STEREO_LEFT";
	picture->timestamp = stampFrom(node.stamp);
	picture->cameraPose = toMrpt(run.camera->T_body_camera);
	const TStereoCamera& c = run.camera->camera;
	picture->cameraParams.ncols = static_cast<uint32_t>(c.width);
	picture->cameraParams.nrows = static_cast<uint32_t>(c.height);
	picture->cameraParams.setIntrinsicParamsFromValues(c.fx, c.fy, c.cx, c.cy);
	picture->image.setExternalStorage(fs::relative(run.file(node.picture), folder).string());
	return picture;
}

/** Back to the body's axes, where MRPT's conversion wants it. */
Matrix6d inBodyAxes(const TNodeRow& node)
{
	const Eigen::Isometry3d T_body_map = node.T_map_body.inverse();
	return covarianceInMap(T_body_map, node.covariance);
}
}  // namespace

void writeSimpleMap(const TRunData& run, const std::string& path)
{
	mrpt::maps::CSimpleMap map;
	for (const TNodeRow& node : run.nodes) {
		if (node.picture.empty() || !run.camera) continue;
		auto frame = mrpt::obs::CSensoryFrame::Create();
		frame->insert(pictureOf(node, run, fs::path(path).parent_path()));
		auto pose = mrpt::poses::CPose3DPDFGaussian::Create();
		*pose = toMrptGaussian(node.T_map_body, inBodyAxes(node));
		map.insert(pose, frame);
	}
	savedWhole(path, [&](const std::string& part) { return map.saveToFile(part); });
}

// ------------------------------------------------------------------------------------------ scene.3Dscene

namespace
{
mrpt::opengl::CSetOfLines::Ptr lineOf(
	const TTrajectory& poses, const char* name, const TColor& colour, float width)
{
	auto line = mrpt::opengl::CSetOfLines::Create();
	line->setName(name);
	line->setColor_u8(colour);
	line->setLineWidth(width);
	for (size_t k = 1; k < poses.size(); k++) {
		const Vector3d a = poses[k - 1].T.translation(), b = poses[k].T.translation();
		line->appendLine(a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
	}
	return line;
}

mrpt::opengl::CSetOfLines::Ptr loopLines(const TRunData& run)
{
	auto lines = mrpt::opengl::CSetOfLines::Create();
	lines->setName("loop closings");
	lines->setColor_u8(0xe6, 0x9f, 0x00, 90);
	lines->setLineWidth(1);
	const TTrajectory& nodes = run.trajectory("nodes");
	for (const TLoopRow& row : run.loops) {
		if (!row.accepted() || row.consecutive() || row.from >= nodes.size() || row.to >= nodes.size())
			continue;
		const Vector3d a = nodes[row.from].T.translation(), b = nodes[row.to].T.translation();
		lines->appendLine(a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
	}
	return lines;
}

/** The mosaic: its columns run east (y) and its rows south (-x); MRPT has columns along x and rows along y.
 */
mrpt::opengl::CTexturedPlane::Ptr floorPlane(const TFloorMosaic& mosaic)
{
	cv::Mat turned;
	cv::transpose(mosaic.image, turned);  // rows west to east: along y; columns north to south
	cv::flip(turned, turned, 1);		  // ... south to north: along x
	auto plane = mrpt::opengl::CTexturedPlane::Create(
		static_cast<float>(mosaic.north_min), static_cast<float>(mosaic.north_max),
		static_cast<float>(mosaic.east_min), static_cast<float>(mosaic.east_max));
	plane->setName("floor");
	plane->setLocation(0, 0, mosaic.depth);
	plane->assignImage(mrpt::img::CImage(turned, mrpt::img::DEEP_COPY));
	plane->CRenderizableShaderTexturedTriangles::enableLight(false);
	return plane;
}

Eigen::AlignedBox3d boundsOf(const TRunData& run)
{
	Eigen::AlignedBox3d box;
	for (const auto& [name, poses] : run.trajectories)
		for (const TStampedPose& pose : poses)
			box.extend(Vector3d(pose.T.translation()));
	return box;
}

mrpt::opengl::CGridPlaneXY::Ptr gridUnder(const Eigen::AlignedBox3d& box)
{
	const auto at = [](double v, double step) { return static_cast<float>(5 * std::floor(v / 5) + step); };
	auto grid = mrpt::opengl::CGridPlaneXY::Create(
		at(box.min().x(), 0), at(box.max().x(), 5), at(box.min().y(), 0), at(box.max().y(), 5), 0.0f, 5.0f);
	grid->setName("grid of 5 m at the surface");
	grid->setColor_u8(0x90, 0x90, 0x90, 0x60);
	return grid;
}
}  // namespace

void writeScene(const TRunData& run, const std::string& path, const std::optional<TFloorMosaic>& floor)
{
	auto root = mrpt::opengl::CSetOfObjects::Create();
	root->setName("map (north east down)");
	root->setPose(mrpt::poses::CPose3D(0, 0, 0, 0, 0, M_PI));
	root->insert(gridUnder(boundsOf(run)));
	root->insert(mrpt::opengl::stock_objects::CornerXYZSimple(2, 3));
	if (floor) root->insert(floorPlane(*floor));
	root->insert(lineOf(run.trajectory("truth"), "ground truth", TColor(0x00, 0x9e, 0x73), 4));
	root->insert(lineOf(run.trajectory("odom"), "odometry", TColor(0xd5, 0x5e, 0x00), 2));
	const bool slam = !run.trajectory("nodes").empty();
	root->insert(lineOf(
		run.trajectory(slam ? "nodes" : "ekf"), slam ? "SLAM, final nodes" : "navigation filter",
		TColor(0x00, 0x72, 0xb2), 2));
	if (slam) root->insert(loopLines(run));
	mrpt::opengl::COpenGLScene scene;
	scene.insert(root);
	savedWhole(path, [&](const std::string& part) { return scene.saveToFile(part); });
}

void writeExports(const TRunData& run, const std::string& folder, const std::optional<TFloorMosaic>& floor)
{
	makeFolder(folder);
	const auto write = [&](const char* name, const std::string& text) {
		writeFileWhole(folder + "/" + name, [&](std::ostream& out) { out << text; });
	};
	write("trajectory.kml", kmlOf(run));
	write("trajectory.geojson", geoJsonOf(run));
	writeScene(run, folder + "/scene.3Dscene", floor);
	if (run.nodes.empty()) return;
	write("photos.csv", photoPositionsCsv(run));
	writeSimpleMap(run, folder + "/map.simplemap");
}
}  // namespace posidonia
