#pragma once

// Heavy: instantiates MRPT's engine. Include it in engine.cpp only; everyone else uses stereo_slam.h.
#include <mrpt/graphslam/CGraphSlamEngine.h>
#include <posidonia/graphslam/slam_parts.h>

namespace posidonia
{
/** MRPT's engine with its optimised poses kept. MRPT's own step rebuilds all nodes by Dijkstra along the
 * edges after each optimisation (MRPT/mrpt#985), throws the root to the identity and needs a window in
 * places; this step runs the node decider, the edge deciders and the optimiser, and leaves their poses alone.
 * Headless. */
class CStereoGraphSlamEngine : public mrpt::graphslam::CGraphSlamEngine<TSlamGraph>
{
   public:
	using TNodeDecider = mrpt::graphslam::deciders::CNodeRegistrationDecider<TSlamGraph>;
	using TEdgeDecider = mrpt::graphslam::deciders::CEdgeRegistrationDecider<TSlamGraph>;
	using TOptimizer = mrpt::graphslam::optimizers::CGraphSlamOptimizer<TSlamGraph>;

	/** The four references must outlive the engine (MRPT keeps raw pointers and never deletes them). */
	CStereoGraphSlamEngine(
		const std::string& config_file, TSlamParts& parts, TNodeDecider& node_decider,
		TEdgeDecider& edge_decider, TOptimizer& optimizer);

	bool _execGraphSlamStep(
		mrpt::obs::CActionCollection::Ptr& action, mrpt::obs::CSensoryFrame::Ptr& observations,
		mrpt::obs::CObservation::Ptr& observation, size_t& rawlog_entry) override;

	/** Did the last step add a node? */
	bool addedNode() const { return m_added_node; }

	/** The graph with every pose composed along its edges from the root: what MRPT's engine would have kept.
	 */
	TSlamGraph dijkstraGraph() const;

   private:
	bool m_added_node{false};
};
}  // namespace posidonia
