// auv-graphslam with one decider more: docs/own-decider.md goes through it step by step.
#include <posidonia/apps/CGraphSlamApp.h>
#include <posidonia/graphslam/CStereoERD.h>
#include <posidonia/graphslam/decider_registry.h>

#include <algorithm>

using namespace posidonia;

// (1) A stereo edge decider says which earlier nodes to register the newest one against. What follows,
// matching, PnP, refinement, information, the gate and the record of every candidate, is CStereoERD's.
class CNearestERD : public CStereoERD
{
   protected:
	// (2) The few nodes whose present poses are nearest, the ones just passed left out.
	TChosen chooseCandidates(int j, const TSlamParts::TRig&) override
	{
		constexpr int kJustPassed = 10;
		constexpr size_t kNearest = 3;
		const CSlamMap& map = m_parts->map;
		const auto distance = [&](int i) {
			return (map.pose(i).translation() - map.pose(j).translation()).norm();
		};
		std::vector<int> nodes;
		for (int i = 0; i + kJustPassed <= j; i++)
			nodes.push_back(i);
		const size_t wanted = std::min(kNearest, nodes.size());
		std::partial_sort(
			nodes.begin(), nodes.begin() + static_cast<long>(wanted), nodes.end(),
			[&](int a, int b) { return distance(a) < distance(b); });
		nodes.resize(wanted);
		return {nodes, {}};
	}

	// (3) How its edges are counted and shown.
	EEdgeKind kind() const override { return EEdgeKind::ROI; }
};

int main(int argc, char** argv)
{
	// (4) From here on every ini and command line knows it by its name.
	addEdgeDecider<CNearestERD>("CNearestERD", "Loop closings to the three nearest nodes");
	return runApp<CGraphSlamApp>(argc, argv);
}
