#pragma once

#include <mrpt/graphslam/interfaces/CGraphSlamOptimizer.h>
#include <posidonia/graphslam/graph_priors.h>
#include <posidonia/graphslam/slam_parts.h>

namespace posidonia
{
/** Optimises the graph (paper, eq. 2) with libs/posegraph whenever a stereo edge was added, and tells the
 * loop gate how sure the graph is. The root is held fixed. */
class CSparseGSO : public mrpt::graphslam::optimizers::CGraphSlamOptimizer<TSlamGraph>,
				   public CUsesSlamParts,
				   public CRelativeUncertainty
{
   public:
	void useParts(TSlamParts& parts) override;

	bool updateState(
		mrpt::obs::CActionCollection::Ptr action, mrpt::obs::CSensoryFrame::Ptr observations,
		mrpt::obs::CObservation::Ptr observation) override;
	bool justFullyOptimizedGraph() const override { return m_just_optimized; }

	std::vector<Matrix6d> relativeCovariances(
		const CSlamMap& map, const std::vector<int>& is, int j) override;

   protected:
	void optimizeGraph() override;

   private:
	/** Takes over what is new in the map; true when that is a reason to optimise. */
	bool follow();
	void updateIncrementally();
	/** The graph's poses to the map. */
	void handOver();
	/** The optimum of what is there, at the end of a run. */
	void makeExact();

	CPoseGraph m_pose_graph;
	std::unique_ptr<CIncrementalOptimizer> m_incremental;
	std::unique_ptr<CSparseOptimizer> m_batch;
	std::optional<CMarginals>
		m_marginals;  // batch: of the first m_marginal_nodes nodes, until the next optimisation
	int m_marginal_nodes{0}, m_followed_nodes{0};
	bool m_just_optimized{false};
	size_t m_revised_seen{0};		   ///< Of the map's revised edges
	std::vector<int> m_changed_edges;  ///< Since the last optimisation
};

/** The map as a pose graph: nodes at their present poses, the root fixed or with its prior, robust losses on
 * the stereo edges, priors (default: edges alone). */
CPoseGraph toPoseGraph(
	const CSlamMap& map, const TGraphLossOptions& loss, const TPriorOptions& priors = TPriorOptions::none());
}  // namespace posidonia
