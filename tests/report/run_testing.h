#pragma once

#include <posidonia/base/files.h>
#include <posidonia/report/run_report.h>
#include <temp_folder.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

namespace posidonia::testing
{
/** A vehicle that swims east at 3.5 m over a floor at 6 m, a node each half metre, every picture grey with a
 * white spot in the middle; SLAM is 1 cm off to the north, and every node closes a loop with the first. */
inline TRunData swimEast(const std::string& folder, int nodes = 12)
{
	TRunData run;
	run.folder = folder;
	run.info = {"auv-test", "swim <east>", "Posidonia of a test", "truth.tum",
				false,		1000,		   double(nodes),		  {}};
	TStereoCamera camera;
	camera.width = 160, camera.height = 120, camera.fx = camera.fy = 100, camera.cx = 79.5, camera.cy = 59.5;
	Eigen::Isometry3d T_body_camera = Eigen::Isometry3d::Identity();
	T_body_camera.linear() = downLookingCamera();
	run.camera = TRunData::TCamera{camera, T_body_camera};
	makeFolder(folder + "/loops");
	cv::Mat1b picture(120, 160, uchar(90));
	picture(cv::Rect(77, 57, 6, 6)) = 250;
	for (int i = 0; i < nodes; i++) {
		TNodeRow node;
		node.node = i;
		node.stamp = 1000 + i;
		node.T_map_body.linear() = rotationFromYawPitchRoll(M_PI / 2, 0, 0);
		node.T_map_body.translation() = Eigen::Vector3d(0, 0.5 * i, 3.5);
		run.trajectories["truth"].push_back({node.stamp, node.T_map_body});
		node.T_map_body.translation().x() += 0.01;
		node.covariance = 1e-4 * Matrix6d::Identity();
		node.points = 100 + i;
		node.altitude = 2.5;
		node.picture = "loops/" + std::to_string(i) + ".jpg";
		cv::imwrite(folder + "/" + node.picture, picture);
		run.trajectories["nodes"].push_back({node.stamp, node.T_map_body});
		run.trajectories["odom"].push_back({node.stamp, node.T_map_body});
		run.nodes.push_back(node);
		if (i == 0) continue;
		TLoopRow loop;
		loop.from = 0, loop.to = uint64_t(i);
		loop.kind = "roi", loop.status = "accepted";
		loop.matches = 50, loop.inliers = 40, loop.rmse = 0.2, loop.weight = 1;
		loop.T_from_to = run.nodes[0].T_map_body.inverse() * node.T_map_body;
		loop.T_from_to->translation().x() += 0.001 * i;	 // node i has a residual of i mm
		run.loops.push_back(loop);
		run.matches[{0, i}] = {0, i, 1.5, {{{10, 20}, {30, 40}}, {{50, 60}, {159, 119}}}};
	}
	return run;
}

inline nlohmann::json jsonOf(const TRunData& run, const TReportLimits& limits = {})
{
	return nlohmann::json::parse(runReportJson(run, floorMosaic(run), limits));
}
}  // namespace posidonia::testing
