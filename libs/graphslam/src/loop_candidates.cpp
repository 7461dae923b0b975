#include <posidonia/graphslam/loop_candidates.h>
#include <posidonia/vision/key_frame.h>

#include <algorithm>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;

double medianDepth(const TKeyFrame& key_frame)
{
	if (key_frame.points.empty()) return 0;
	std::vector<double> z;
	for (const auto& p : key_frame.points)
		z.push_back(p.point.z());
	std::nth_element(z.begin(), z.begin() + static_cast<long>(z.size() / 2), z.end());
	return z[z.size() / 2];
}

double predictedOverlap(const TStereoCamera& camera, const Isometry3d& T_cam_i_cam_j, double depth)
{
	constexpr int kColumns = 12, kRows = 9;
	int inside = 0;
	for (int r = 0; r < kRows; r++)
		for (int c = 0; c < kColumns; c++) {
			const double u = (c + 0.5) * camera.width / kColumns, v = (r + 0.5) * camera.height / kRows;
			const Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
			const Vector3d p = T_cam_i_cam_j * Vector3d(depth * ray);
			if (p.z() <= 0) continue;
			const Vector3d seen = camera.project(p);
			inside += seen.x() >= 0 && seen.x() < camera.width && seen.y() >= 0 && seen.y() < camera.height;
		}
	return static_cast<double>(inside) / (kColumns * kRows);
}

std::vector<TCandidate> candidatesInRoi(
	const CSlamMap& map, int j, const TRoiOptions& options, const TStereoCamera& camera,
	const Isometry3d& T_body_camera)
{
	std::vector<TCandidate> candidates;
	const Isometry3d T_map_j = map.pose(j);
	const double depth = medianDepth(*map.node(j).key_frame);
	for (int i = 0; i + options.min_node_gap <= j; i++) {
		const Isometry3d T_map_i = map.pose(i);
		if ((T_map_i.translation() - T_map_j.translation()).norm() > options.radius) continue;
		const Isometry3d T_cam_i_cam_j =
			T_body_camera.inverse() * T_map_i.inverse() * T_map_j * T_body_camera;
		const double overlap = predictedOverlap(camera, T_cam_i_cam_j, depth);
		if (overlap >= options.min_overlap) candidates.push_back({i, overlap});
	}
	std::stable_sort(candidates.begin(), candidates.end(), [](const TCandidate& a, const TCandidate& b) {
		return a.overlap > b.overlap;
	});
	return candidates;
}
}  // namespace posidonia
