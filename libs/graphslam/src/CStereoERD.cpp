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
	retryRefused();
	const TChosen chosen = chooseCandidates(j, rig);
	const auto registrations = registerAll(chosen.register_now, j, rig);
	const auto predictions = m_parts->gate.needsCovariance() ? predictAll(chosen.register_now, j)
															 : predictPoses(chosen.register_now, j);
	for (size_t k = 0; k < chosen.register_now.size(); k++)
		judge(chosen.register_now[k], j, registrations[k], predictions[k], rig);
	for (int i : chosen.over_budget)
		map.candidates.push_back({i, j, kind(), "over budget"});
	if (m_parts->options.loss.share_information) map.shareInformation();
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

std::vector<TRelativePrediction> CStereoERD::predictPoses(const std::vector<int>& candidates, int j) const
{
	std::vector<TRelativePrediction> predictions(candidates.size());
	for (size_t k = 0; k < candidates.size(); k++)
		predictions[k].T_i_j = m_parts->map.relativePose(candidates[k], j);
	return predictions;
}

namespace
{
Eigen::Vector3d driftVariance(const TDeclaredDrift& drift, double metres)
{
	const Eigen::Vector3d sigma(drift.sigma_xy * metres, drift.sigma_xy * metres, drift.sigma_z * metres);
	return sigma.cwiseAbs2();
}
}  // namespace

std::vector<TRelativePrediction> CStereoERD::predictAll(const std::vector<int>& candidates, int j) const
{
	const CSlamMap& map = m_parts->map;
	auto predictions = predictPoses(candidates, j);
	if (candidates.empty()) return predictions;

	const mrpt::system::CTimeLoggerEntry timing(m_parts->timer, "predict_for_gate");
	// The newest node hangs on its odometry edge: the graph's own covariance to the node before, and that
	// edge.
	const TSlamEdge* odometry = nullptr;
	for (auto e = map.edges().rbegin(); e != map.edges().rend() && !odometry; ++e)
		if (e->kind == EEdgeKind::ODOMETRY && e->to == j) odometry = &*e;
	const auto to_previous = m_parts->uncertainty->relativeCovariances(map, candidates, j - 1);
	const auto metres = map.odometryMetresTo(j);
	for (size_t k = 0; k < candidates.size(); k++) {
		const Matrix6d own =
			composeCovariance(to_previous[k], odometry->T_from_to, odometry->information.inverse());
		predictions[k].covariance = largerOfGraphAndDrift(
			own, map.pose(j).linear(),
			driftVariance(m_parts->odometry.declaredDrift(), metres[static_cast<size_t>(candidates[k])]));
	}
	return predictions;
}

CStereoERD::TMeasured CStereoERD::measured(
	int i, int j, const TRegistration& registration, const TSlamParts::TRig& rig) const
{
	// From the cameras to the bodies: T_i_j = T_body_cam T_ci_cj T_cam_body.
	const Isometry3d T_cam_body = rig.T_body_camera.inverse();
	const Matrix6d A = adjoint(T_cam_body);
	TMeasured m{
		rig.T_body_camera * registration.T_a_b * T_cam_body,
		A.transpose() * registration.information * A,
		{}};
	const auto &places_i = m_parts->map.node(i).places, &places_j = m_parts->map.node(j).places;
	for (const auto& [p, q] : registration.inlier_pairs)
		m.points.emplace_back(places_i[static_cast<size_t>(p)], places_j[static_cast<size_t>(q)]);
	return m;
}

void CStereoERD::judge(
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
	if (registration.accepted()) {
		const TMeasured m = measured(i, j, registration, rig);
		row.T_from_to = m.T_i_j;
		row.measured = true;
		if (const auto refusal = m_parts->gate.refuse(prediction, m.T_i_j, m.information)) {
			row.status = *refusal;
			m_refused.push_back({m_parts->map.candidates.size(), m, prediction});
		}
		else
			accept(row, "accepted", m);
	}
	m_parts->map.candidates.push_back(row);
}

void CStereoERD::accept(TCandidateRow& row, const char* status, const TMeasured& m)
{
	row.status = status;
	m_parts->map.addEdge({row.from, row.to, kind(), m.T_i_j, m.information, 0, m.points});
	m_just_inserted_lc = m_just_inserted_lc || kind() == EEdgeKind::ROI;
	m_edges++;
}

bool CStereoERD::hasMoved(const TRefused& pair) const
{
	const TCandidateRow& row = m_parts->map.candidates[pair.row];
	const Vector6d d = localCoordinates(pair.prediction.T_i_j, m_parts->map.relativePose(row.from, row.to));
	const double sigmas2 = d.dot(pair.prediction.covariance.ldlt().solve(d));
	return sigmas2 > m_parts->options.gate.retry_moved * m_parts->options.gate.retry_moved;
}

TRelativePrediction CStereoERD::predictNow(int i, int j) const
{
	const CSlamMap& map = m_parts->map;
	const double metres = map.odometryMetresTo(j)[static_cast<size_t>(i)];
	const Matrix6d own = m_parts->uncertainty->relativeCovariances(map, {i}, j).front();
	return {
		map.relativePose(i, j),
		largerOfGraphAndDrift(
			own, map.pose(j).linear(), driftVariance(m_parts->odometry.declaredDrift(), metres))};
}

void CStereoERD::retryRefused()
{
	/** Bounds of the work a node: pairs remembered, pairs judged. */
	constexpr size_t kRemembered = 200;
	constexpr int kJudged = 10;
	if (m_parts->options.gate.retry_moved == 0 || !m_parts->gate.needsCovariance()) m_refused.clear();
	while (m_refused.size() > kRemembered)
		m_refused.pop_front();
	std::deque<TRefused> still;
	int judged = 0;
	for (TRefused& pair : m_refused) {
		TCandidateRow& row = m_parts->map.candidates[pair.row];
		if (judged < kJudged && hasMoved(pair)) {
			judged++;
			pair.prediction = predictNow(row.from, row.to);
			if (!m_parts->gate.refuse(pair.prediction, pair.measured.T_i_j, pair.measured.information)) {
				accept(row, "accepted on retry", pair.measured);
				continue;
			}
		}
		still.push_back(std::move(pair));
	}
	m_refused = std::move(still);
}

void CStereoERD::getEdgesStats(std::map<std::string, int>* edge_type_to_num) const
{
	(*edge_type_to_num)[toString(kind())] = m_edges;
}
}  // namespace posidonia
