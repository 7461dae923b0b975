// TUserOptionsChecker.h leans on what the engine header brings in before it (no engine is instantiated here).
#include <mrpt/graphslam/CGraphSlamEngine.h>

#include <mrpt/graphslam/apps_related/TUserOptionsChecker.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/graphslam/CDistanceNRD.h>
#include <posidonia/graphslam/CSparseGSO.h>
#include <posidonia/graphslam/decider_registry.h>
#include <posidonia/graphslam/stereo_deciders.h>

#include <algorithm>
#include <set>

namespace posidonia
{
namespace
{
using mrpt::graphslam::apps::TOptimizerProps;
using mrpt::graphslam::apps::TRegistrationDeciderProps;

/** MRPT's table with ours in it; what does not work in 3D observation logs is left out. */
class CDeciderRegistry : public mrpt::graphslam::apps::TUserOptionsChecker<TSlamGraph>
{
   public:
	CDeciderRegistry()
	{
		createDeciderOptimizerMappings();
		populateDeciderOptimizerProperties();
	}

	void createDeciderOptimizerMappings() override
	{
		using namespace mrpt::graphslam;
		node_regs_map["CDistanceNRD"] = &createNodeRegistrationDecider<CDistanceNRD>;
		edge_regs_map["CEmptyERD"] = &createEdgeRegistrationDecider<deciders::CEmptyERD<TSlamGraph>>;
		edge_regs_map["CSequentialStereoERD"] = &createEdgeRegistrationDecider<CSequentialStereoERD>;
		edge_regs_map["CRoiStereoERD"] = &createEdgeRegistrationDecider<CRoiStereoERD>;
		optimizers_map["CSparseGSO"] = &createGraphSlamOptimizer<CSparseGSO>;
		optimizers_map["CLevMarqGSO"] = &createGraphSlamOptimizer<optimizers::CLevMarqGSO<TSlamGraph>>;
	}

	void populateDeciderOptimizerProperties() override
	{
		describe("CDistanceNRD", "Node", "A node each so many metres, at a stereo pair; odometry edges");
		describe("CEmptyERD", "Edge", "No stereo edges: odometry alone (MRPT's own)");
		describe("CSequentialStereoERD", "Edge", "Stereo edges to the previous few nodes");
		describe("CRoiStereoERD", "Edge", "Loop closings by stereo PnP within a sphere (the paper's)");
		describeOptimizer("CSparseGSO", "Sparse SE(3) least squares with robust losses and marginals");
		describeOptimizer("CLevMarqGSO", "MRPT's own Levenberg-Marquardt, for comparison");
	}

	void describe(const std::string& name, const std::string& type, const std::string& description)
	{
		auto* p = new TRegistrationDeciderProps;  // MRPT's base class deletes it
		p->name = name;
		p->type = type;
		p->description = description;
		p->rawlog_format = "#2";
		p->observations_used = {"CObservationStereoImages and what the odometry uses"};
		p->is_slam_2d = false;
		p->is_slam_3d = true;
		regs_descriptions.push_back(p);
	}

   private:
	void describeOptimizer(const std::string& name, const std::string& description)
	{
		auto* p = new TOptimizerProps;
		p->name = name;
		p->description = description;
		p->is_slam_2d = false;
		p->is_slam_3d = true;
		optimizers_descriptions.push_back(p);
	}
};

CDeciderRegistry& registry()
{
	static CDeciderRegistry table;
	return table;
}

/** Makes the object of `name`, gives it the parts if it is one of ours. */
template <class T, class MAP>
std::unique_ptr<T> make(const MAP& map, const std::string& name, const char* what, TSlamParts& parts)
{
	const auto found = map.find(name);
	if (found == map.end()) {
		std::vector<std::string> known;
		for (const auto& entry : map)
			known.push_back(entry.first);
		throw CError(std::string(what) + " '" + name + "'", "is not known", didYouMean(name, known));
	}
	std::unique_ptr<T> made(found->second());
	if (auto* user = dynamic_cast<CUsesSlamParts*>(made.get())) user->useParts(parts);
	return made;
}

std::vector<std::string> words(std::string text)
{
	std::replace(text.begin(), text.end(), ',', ' ');
	std::istringstream in(text);
	std::vector<std::string> list;
	for (std::string word; in >> word;)
		list.push_back(word);
	return list;
}
}  // namespace

std::unique_ptr<TNodeDecider> makeNodeDecider(const std::string& name, TSlamParts& parts)
{
	return make<TNodeDecider>(registry().node_regs_map, name, "node decider", parts);
}

std::unique_ptr<TEdgeDecider> makeEdgeDecider(const std::string& names, TSlamParts& parts)
{
	std::vector<std::unique_ptr<TEdgeDecider>> made;
	std::set<std::string> seen;
	for (const auto& name : words(names)) {
		if (!seen.insert(name).second)
			throw CError(
				"[Slam] edge_deciders", name + " is named twice",
				"its edges would count twice: name it once");
		made.push_back(make<TEdgeDecider>(registry().edge_regs_map, name, "edge decider", parts));
	}
	if (made.empty())
		throw CError("[Slam] edge_deciders", "names no edge decider", "write CEmptyERD for odometry alone");
	if (made.size() == 1) return std::move(made.front());
	return std::make_unique<CCompositeERD>(std::move(made));
}

std::unique_ptr<TGraphOptimizer> makeOptimizer(const std::string& name, TSlamParts& parts)
{
	return make<TGraphOptimizer>(registry().optimizers_map, name, "optimizer", parts);
}

void addEdgeDecider(const std::string& name, const std::string& description, TEdgeDecider* (*make)())
{
	const bool is_new = registry().edge_regs_map.emplace(name, make).second;
	if (!is_new) throw CError("edge decider '" + name + "'", "is there already", "give yours another name");
	registry().describe(name, "Edge", description);
}

std::string listDeciders()
{
	std::string text;
	for (const auto* p : registry().regs_descriptions)
		text += p->type + " decider  " + p->name + ": " + p->description + "\n";
	for (const auto* p : registry().optimizers_descriptions)
		text += "Optimizer     " + p->name + ": " + p->description + "\n";
	return text;
}
}  // namespace posidonia
