#pragma once

#include <posidonia/graphslam/CStereoERD.h>

#include <memory>
#include <vector>

namespace posidonia
{
/** Stereo edges from the newest node to the previous few: visual odometry with memory. */
class CSequentialStereoERD : public CStereoERD
{
   protected:
	TChosen chooseCandidates(int j, const TSlamParts::TRig& rig) override;
	EEdgeKind kind() const override { return EEdgeKind::SEQUENTIAL; }
};

/** The paper's loop closings (sec. 3.2): every previous node in a sphere (Region of Interest) round the
 * present pose, here the best few by predicted overlap of the pictures; the rest is recorded as over budget.
 */
class CRoiStereoERD : public CStereoERD
{
   protected:
	TChosen chooseCandidates(int j, const TSlamParts::TRig& rig) override;
	EEdgeKind kind() const override { return EEdgeKind::ROI; }

   private:
	std::vector<double> horizontalSigmas(int j) const;
};

/** Several edge deciders, run in order. */
class CCompositeERD : public mrpt::graphslam::deciders::CEdgeRegistrationDecider<TSlamGraph>
{
   public:
	using TPart = mrpt::graphslam::deciders::CEdgeRegistrationDecider<TSlamGraph>;
	explicit CCompositeERD(std::vector<std::unique_ptr<TPart>> parts) : m_decider_parts(std::move(parts)) {}

	bool updateState(
		mrpt::obs::CActionCollection::Ptr action, mrpt::obs::CSensoryFrame::Ptr observations,
		mrpt::obs::CObservation::Ptr observation) override;
	void setGraphPtr(TSlamGraph* graph) override;
	bool justInsertedLoopClosure() const override;
	void getEdgesStats(std::map<std::string, int>* edge_type_to_num) const override;

   private:
	std::vector<std::unique_ptr<TPart>> m_decider_parts;
};
}  // namespace posidonia
