#pragma once

#include <mrpt/graphslam/interfaces/CEdgeRegistrationDecider.h>
#include <posidonia/graphslam/slam_parts.h>

#include <deque>

namespace posidonia
{
/** What stereo edge deciders share: at a new node its key frame is made, candidates are registered against it
 * by PnP RANSAC and refinement, gated against the graph's own prediction, and become edges; every candidate
 * is recorded. */
class CStereoERD : public mrpt::graphslam::deciders::CEdgeRegistrationDecider<TSlamGraph>,
				   public CUsesSlamParts
{
   public:
	/** Does its work once for each new node. */
	bool updateState(
		mrpt::obs::CActionCollection::Ptr action, mrpt::obs::CSensoryFrame::Ptr observations,
		mrpt::obs::CObservation::Ptr observation) override;

	void getEdgesStats(std::map<std::string, int>* edge_type_to_num) const override;

   protected:
	/** Candidate nodes to register against node j. */
	struct TChosen
	{
		std::vector<int> register_now;
		std::vector<int> over_budget;
	};
	virtual TChosen chooseCandidates(int j, const TSlamParts::TRig& rig) = 0;
	virtual EEdgeKind kind() const = 0;

	/** T_i_j as the graph has it, with its covariance, for the newest node j. */
	std::vector<TRelativePrediction> predictAll(const std::vector<int>& candidates, int j) const;

   private:
	/** A registration of T_i_j in body frames. */
	struct TMeasured
	{
		Eigen::Isometry3d T_i_j;
		Matrix6d information;
		CSharedPoints::TPoints points;
	};
	/** A pair that the gate refused, to be judged again when the graph has moved. */
	struct TRefused
	{
		size_t row;	 ///< Of the map's candidates
		TMeasured measured;
		TRelativePrediction prediction;	 ///< When it was judged last
	};

	std::vector<TRegistration> registerAll(
		const std::vector<int>& candidates, int j, const TSlamParts::TRig& rig) const;
	std::vector<TRelativePrediction> predictPoses(const std::vector<int>& candidates, int j) const;
	void judge(
		int i, int j, const TRegistration& registration, const TRelativePrediction& prediction,
		const TSlamParts::TRig& rig);
	TMeasured measured(int i, int j, const TRegistration& registration, const TSlamParts::TRig& rig) const;
	void accept(TCandidateRow& row, const char* status, const TMeasured& measured);
	void retryRefused();
	bool hasMoved(const TRefused& pair) const;
	TRelativePrediction predictNow(int i, int j) const;

	int m_done_nodes{0};  // nodes already looked at
	int m_edges{0};
	std::deque<TRefused> m_refused;
};
}  // namespace posidonia
