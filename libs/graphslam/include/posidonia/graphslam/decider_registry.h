#pragma once

#include <mrpt/graphslam/interfaces/CEdgeRegistrationDecider.h>
#include <mrpt/graphslam/interfaces/CGraphSlamOptimizer.h>
#include <mrpt/graphslam/interfaces/CNodeRegistrationDecider.h>
#include <posidonia/graphslam/slam_parts.h>

#include <memory>
#include <string>

/** Deciders and optimisers by name. Behind it stands MRPT's own table (TUserOptionsChecker) with ours in it,
 * which is looked up here since MRPT's checks are empty in release builds and an unknown name would crash. */
namespace posidonia
{
using TNodeDecider = mrpt::graphslam::deciders::CNodeRegistrationDecider<TSlamGraph>;
using TEdgeDecider = mrpt::graphslam::deciders::CEdgeRegistrationDecider<TSlamGraph>;
using TGraphOptimizer = mrpt::graphslam::optimizers::CGraphSlamOptimizer<TSlamGraph>;

/** Each throws CError with the names that are known. */
std::unique_ptr<TNodeDecider> makeNodeDecider(const std::string& name, TSlamParts& parts);
/** `names`: one or several, separated by blanks or commas. */
std::unique_ptr<TEdgeDecider> makeEdgeDecider(const std::string& names, TSlamParts& parts);
std::unique_ptr<TGraphOptimizer> makeOptimizer(const std::string& name, TSlamParts& parts);

/** Adds a decider of one's own, before a CStereoSlam is made: [Slam] edge_deciders and --edge-deciders know
 * it then by `name`. @param make new decider; who asks owns it. Throws CError when the name is taken. */
void addEdgeDecider(const std::string& name, const std::string& description, TEdgeDecider* (*make)());
template <class DECIDER>
void addEdgeDecider(const std::string& name, const std::string& description)
{
	addEdgeDecider(name, description, []() -> TEdgeDecider* { return new DECIDER; });
}

/** Name, kind and description of each, for --list-deciders. */
std::string listDeciders();
}  // namespace posidonia
