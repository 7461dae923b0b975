#include <posidonia/graphslam/loop_candidates.h>
#include <posidonia/graphslam/stereo_deciders.h>

namespace posidonia
{
using namespace mrpt::obs;

CStereoERD::TChosen CSequentialStereoERD::chooseCandidates(int j, const TSlamParts::TRig&)
{
	TChosen chosen;
	for (int i = std::max(0, j - m_parts->options.sequential.neighbours); i < j; i++) chosen.register_now.push_back(i);
	return chosen;
}

CStereoERD::TChosen CRoiStereoERD::chooseCandidates(int j, const TSlamParts::TRig& rig)
{
	const TRoiOptions& roi = m_parts->options.roi;
	const auto candidates = candidatesInRoi(m_parts->map, j, roi, rig.camera, rig.T_body_camera);
	TChosen chosen;
	for (size_t k = 0; k < candidates.size(); k++)
	{
		auto& list = k < static_cast<size_t>(roi.max_candidates) ? chosen.register_now : chosen.over_budget;
		list.push_back(candidates[k].node);
	}
	return chosen;
}

bool CCompositeERD::updateState(
	CActionCollection::Ptr action, CSensoryFrame::Ptr observations, CObservation::Ptr observation)
{
	bool all = true;
	for (auto& part : m_decider_parts) all = part->updateState(action, observations, observation) && all;
	return all;
}

void CCompositeERD::setGraphPtr(TSlamGraph* graph)
{
	TPart::setGraphPtr(graph);
	for (auto& part : m_decider_parts) part->setGraphPtr(graph);
}

void CCompositeERD::getEdgesStats(std::map<std::string, int>* edge_type_to_num) const
{
	for (const auto& part : m_decider_parts) part->getEdgesStats(edge_type_to_num);
}
}  // namespace posidonia
