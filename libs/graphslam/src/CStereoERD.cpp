#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/graphslam/CStereoERD.h>

#include "parallel_for.h"

namespace posidonia
{
using Eigen::Isometry3d;
using namespace mrpt::obs;

bool CStereoERD::updateState(CActionCollection::Ptr, CSensoryFrame::Ptr, CObservation::Ptr observation)
{
	CSlamMap& map = m_parts->map;
	const auto pair = std::dynamic_pointer_cast<CObservationStereoImages>(observation);
	if (!pair || map.nodeCount() == m_done_nodes) return true;
	m_done_nodes = map.nodeCount();
	m_just_inserted_lc = false;

	const int j = map.lastNode();
	m_parts->keyFrameOf(j, *pair);
	const auto& rig = m_parts->rigOf(*pair);
	const TChosen chosen = chooseCandidates(j, rig);
	const auto registrations = registerAll(chosen.register_now, j, rig);
	const auto predictions = predictAll(chosen.register_now, j);
	for (size_t k = 0; k < chosen.register_now.size(); k++)
		map.candidates.push_back(judge(chosen.register_now[k], j, registrations[k], predictions[k], rig));
	for (int i : chosen.over_budget)
		map.candidates.push_back({i, j, kind(), "over budget"});
	return true;
}

std::vector<TRegistration> CStereoERD::registerAll(
	const std::vector<int>& candidates, int j, const TSlamParts::TRig& rig) const
{
	const mrpt::system::CTimeLoggerEntry timing(m_parts->timer, "register_candidates");
	const CSlamMap& map = m_parts->map;
	std::vector<TRegistration> results(candidates.size());
	parallelFor(candidates.size(), m_parts->options.slam.threads, [&](size_t k) {
		const int i = candidates[k];
		const auto seed = static_cast<unsigned>(i) * 2654435761U + static_cast<unsigned>(j);
		results[k] = rig.registration.align(*map.node(i).key_frame, *map.node(j).key_frame, seed);
	});
	return results;
}

std::vector<TRelativePrediction> CStereoERD::predictAll(const std::vector<int>& candidates, int j) const
{
	const CSlamMap& map = m_parts->map;
	std::vector<TRelativePrediction> predictions(candidates.size());
	for (size_t k = 0; k < candidates.size(); k++)
		predictions[k].T_i_j = map.relativePose(candidates[k], j);
	if (candidates.empty() || !m_parts->gate.needsCovariance()) return predictions;

	const mrpt::system::CTimeLoggerEntry timing(m_parts->timer, "predict_for_gate");
	// The newest node hangs on its odometry edge: the graph's own covariance to the node before, and that
	// edge.
	const TSlamEdge* odometry = nullptr;
	for (auto e = map.edges().rbegin(); e != map.edges().rend() && !odometry; ++e)
		if (e->kind == EEdgeKind::ODOMETRY && e->to == j) odometry = &*e;
	const auto to_previous = m_parts->uncertainty->relativeCovariances(map, candidates, j - 1);
	const auto metres = map.odometryMetresTo(j);
	const TDeclaredDrift drift = m_parts->odometry.declaredDrift();
	for (size_t k = 0; k < candidates.size(); k++) {
		const Matrix6d own =
			composeCovariance(to_previous[k], odometry->T_from_to, odometry->information.inverse());
		const double m = metres[static_cast<size_t>(candidates[k])];
		const Eigen::Vector3d sigma(drift.sigma_xy * m, drift.sigma_xy * m, drift.sigma_z * m);
		predictions[k].covariance = largerOfGraphAndDrift(own, map.pose(j).linear(), sigma.cwiseAbs2());
	}
	return predictions;
}

TCandidateRow CStereoERD::judge(
	int i, int j, const TRegistration& registration, const TRelativePrediction& prediction,
	const TSlamParts::TRig& rig)
{
	TCandidateRow row{
		i,
		j,
		kind(),
		toString(registration.status),
		registration.matches,
		registration.inliers,
		registration.rmse_px};
	if (!registration.accepted()) return row;
	// From the cameras to the bodies: T_i_j = T_body_cam T_ci_cj T_cam_body.
	const Isometry3d T_cam_body = rig.T_body_camera.inverse();
	row.T_from_to = rig.T_body_camera * registration.T_a_b * T_cam_body;
	row.measured = true;
	const Matrix6d A = adjoint(T_cam_body);
	const Matrix6d information = A.transpose() * registration.information * A;
	if (const auto refusal = m_parts->gate.refuse(prediction, row.T_from_to, information)) {
		row.status = *refusal;
		return row;
	}
	m_parts->map.addEdge({i, j, kind(), row.T_from_to, information});
	m_just_inserted_lc = m_just_inserted_lc || kind() == EEdgeKind::ROI;
	m_edges++;
	return row;
}

void CStereoERD::getEdgesStats(std::map<std::string, int>* edge_type_to_num) const
{
	(*edge_type_to_num)[toString(kind())] = m_edges;
}
}  // namespace posidonia
