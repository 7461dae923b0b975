#include <posidonia/graphslam/loop_candidates.h>
#include <posidonia/graphslam/stereo_deciders.h>

#include <algorithm>
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

CStereoERD::TChosen CRoiStereoERD::chooseCandidates(int j, const TSlamParts::TRig& rig)
{
	const TRoiOptions& roi = m_parts->options.roi;
	const auto tried = triedAgainst(j, m_parts->map);
	TChosen chosen;
	for (const auto& candidate : candidatesInRoi(m_parts->map, j, roi, rig.camera, rig.T_body_camera)) {
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
