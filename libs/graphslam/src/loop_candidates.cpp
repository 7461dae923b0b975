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

namespace
{
/** T_map_j moved level towards node i by `reach` [m] at most: the best place for their overlap. */
Isometry3d nearest(const Isometry3d& T_map_i, const Isometry3d& T_map_j, double reach)
{
	Vector3d way = T_map_i.translation() - T_map_j.translation();
	way.z() = 0;
	Isometry3d T = T_map_j;
	T.translation() += std::min(1.0, reach / way.norm()) * way;
	return T;
}
}  // namespace

std::vector<TCandidate> candidatesInRoi(
	const CSlamMap& map, int j, const TRoiOptions& options, const TStereoCamera& camera,
	const Isometry3d& T_body_camera, const std::vector<double>& sigma)
{
	std::vector<TCandidate> likely;
	std::vector<std::pair<double, TCandidate>> possible;  // with the distance
	const Isometry3d T_map_j = map.pose(j);
	const double depth = medianDepth(*map.node(j).key_frame);
	const auto overlap = [&](const Isometry3d& T_map_i, const Isometry3d& T_map_j_) {
		const Isometry3d T_cam_i_cam_j =
			T_body_camera.inverse() * T_map_i.inverse() * T_map_j_ * T_body_camera;
		return predictedOverlap(camera, T_cam_i_cam_j, depth);
	};
	for (int i = 0; i + options.min_node_gap <= j; i++) {
		const double reach = sigma.empty() ? 0 : options.sigmas * sigma[static_cast<size_t>(i)];
		const double radius = std::max(options.radius, std::min(reach, options.radius_max));
		const Isometry3d T_map_i = map.pose(i);
		const double distance = (T_map_i.translation() - T_map_j.translation()).norm();
		if (distance > radius) continue;
		const double predicted = overlap(T_map_i, T_map_j);
		if (predicted >= options.min_overlap) {
			likely.push_back({i, predicted, false});
			continue;
		}
		const double best = reach > 0 ? overlap(T_map_i, nearest(T_map_i, T_map_j, reach)) : 0;
		if (best >= options.min_overlap) possible.push_back({distance, {i, best, true}});
	}
	std::stable_sort(likely.begin(), likely.end(), [](const TCandidate& a, const TCandidate& b) {
		return a.overlap > b.overlap;
	});
	std::stable_sort(
		possible.begin(), possible.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
	for (const auto& p : possible)
		likely.push_back(p.second);
	return likely;
}
}  // namespace posidonia
