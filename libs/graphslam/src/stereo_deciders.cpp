#include <posidonia/graphslam/loop_candidates.h>
#include <posidonia/graphslam/stereo_deciders.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace posidonia
{
using namespace mrpt::obs;

CStereoERD::TChosen CSequentialStereoERD::chooseCandidates(int j, const TSlamParts::TRig&)
{
	TChosen chosen;
	for (int i = std::max(0, j - m_parts->options.sequential.neighbours); i < j; i++)
		chosen.register_now.push_back(i);
	return chosen;
}

namespace
{
/** Nodes that an earlier decider has tried against node j: the same pictures again would count twice. */
std::set<int> triedAgainst(int j, const CSlamMap& map)
{
	std::set<int> tried;
	for (auto row = map.candidates.rbegin(); row != map.candidates.rend() && row->to == j; ++row)
		tried.insert(row->from);
	return tried;
}
}  // namespace

/** Sigma [m] of each node's horizontal place seen from j, largest direction; empty when it is not asked for
 * or nothing is in reach. */
std::vector<double> CRoiStereoERD::horizontalSigmas(int j) const
{
	/** Neighbours in time are tied to each other, so few nodes speak for all: at most so many, evenly taken
	 * from those in reach. */
	constexpr size_t kAsked = 8;
	const CSlamMap& map = m_parts->map;
	const TRoiOptions& roi = m_parts->options.roi;
	const Eigen::Vector3d here = map.pose(j).translation();
	std::vector<int> in_reach, asked;
	for (int i = 0; roi.sigmas > 0 && i + roi.min_node_gap <= j; i++)
		if ((map.pose(i).translation() - here).norm() <= std::max(roi.radius, roi.radius_max))
			in_reach.push_back(i);
	if (in_reach.empty()) return {};
	const size_t step = (in_reach.size() + kAsked - 1) / kAsked;
	for (size_t k = 0; k < in_reach.size(); k += step)
		asked.push_back(in_reach[k]);
	const auto predictions = predictAll(asked, j);
	const Eigen::Matrix3d R_map_j = map.pose(j).linear();
	std::vector<double> sigma(static_cast<size_t>(map.nodeCount()), 0);
	for (size_t k = 0; k < asked.size(); k++) {
		const Eigen::Matrix3d C =
			R_map_j * predictions[k].covariance.topLeftCorner<3, 3>() * R_map_j.transpose();
		const Eigen::Vector2d variances =
			Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(C.topLeftCorner<2, 2>()).eigenvalues();
		const int last = k + 1 < asked.size() ? asked[k + 1] : map.nodeCount();
		for (int i = asked[k]; i < last; i++)
			sigma[static_cast<size_t>(i)] = std::sqrt(std::max(0.0, variances.maxCoeff()));
	}
	return sigma;
}

CStereoERD::TChosen CRoiStereoERD::chooseCandidates(int j, const TSlamParts::TRig& rig)
{
	const TRoiOptions& roi = m_parts->options.roi;
	const auto tried = triedAgainst(j, m_parts->map);
	TChosen chosen;
	for (const auto& candidate :
		 candidatesInRoi(m_parts->map, j, roi, rig.camera, rig.T_body_camera, horizontalSigmas(j)))
	{
		if (tried.count(candidate.node)) continue;
		const bool in_budget = chosen.register_now.size() < static_cast<size_t>(roi.max_candidates);
		(in_budget ? chosen.register_now : chosen.over_budget).push_back(candidate.node);
	}
	return chosen;
}

bool CCompositeERD::updateState(
	CActionCollection::Ptr action, CSensoryFrame::Ptr observations, CObservation::Ptr observation)
{
	bool all = true;
	for (auto& part : m_decider_parts)
		all = part->updateState(action, observations, observation) && all;
	return all;
}

void CCompositeERD::setGraphPtr(TSlamGraph* graph)
{
	TPart::setGraphPtr(graph);
	for (auto& part : m_decider_parts)
		part->setGraphPtr(graph);
}

bool CCompositeERD::justInsertedLoopClosure() const
{
	return std::any_of(m_decider_parts.begin(), m_decider_parts.end(), [](const auto& part) {
		return part->justInsertedLoopClosure();
	});
}

void CCompositeERD::getEdgesStats(std::map<std::string, int>* edge_type_to_num) const
{
	for (const auto& part : m_decider_parts)
		part->getEdgesStats(edge_type_to_num);
}
}  // namespace posidonia
