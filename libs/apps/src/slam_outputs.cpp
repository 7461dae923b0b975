#include <posidonia/apps/run_texts.h>
#include <posidonia/apps/slam_outputs.h>
#include <posidonia/eval/trajectory_io.h>

namespace posidonia
{
TMetrics TSlamCounts::metrics() const
{
	return {
		{"graph.nodes", "", static_cast<double>(nodes)},
		{"graph.sequential_edges", "", static_cast<double>(sequential_edges)},
		{"graph.roi_edges", "", static_cast<double>(roi_edges)},
		{"graph.chi2", "", chi2},
		{"graph.chi2_dijkstra", "", dijkstra_chi2}};
}

std::string TSlamCounts::text() const
{
	return mrpt::format(
		"%d nodes, %d sequential and %d ROI edges; chi2 %.1f (composed from the root: %.3g)", nodes,
		sequential_edges, roi_edges, chi2, dijkstra_chi2);
}

TSlamCounts countsOf(const CStereoSlam& slam)
{
	TSlamCounts counts;
	counts.nodes = slam.map().nodeCount();
	if (counts.nodes == 0) return counts;  // no picture, or never a pose
	for (const auto& edge : slam.map().edges()) {
		counts.sequential_edges += edge.kind == EEdgeKind::SEQUENTIAL;
		counts.roi_edges += edge.kind == EEdgeKind::ROI;
	}
	counts.chi2 = slam.chi2();
	counts.dijkstra_chi2 = slam.dijkstraChi2();
	return counts;
}

void rememberCausal(const CStereoSlam& slam, TRunTrajectories& t)
{
	if (slam.causal().size() == t.slam.size()) return;
	const TCausalPose pose = slam.causal().back();
	t.ekf.push_back({pose.stamp, uncorruptedPose(slam.odometry())});
	t.odom.push_back({pose.stamp, pose.T_odom_body});
	t.slam.push_back({pose.stamp, pose.T_map_body});
}

void writeSlamFiles(const CRunFolder& folder, const CStereoSlam& slam, const TRunTrajectories& t)
{
	writeTum(folder.file("ekf.tum"), t.ekf);
	writeTum(folder.file("odom.tum"), t.odom);
	writeTum(folder.file("slam.tum"), t.slam);
	writeTum(folder.file("nodes.tum"), t.nodes);
	slam.saveG2o(folder.file("graph.g2o"));
	folder.write("loops.csv", candidatesCsv(slam.map().candidates));
	folder.write("timings.csv", timingsCsv(slam.timer(), slam.map().nodeCount()));
}
}  // namespace posidonia
