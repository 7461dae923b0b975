#pragma once

#include <posidonia/base/options.h>

#include <string>

namespace posidonia
{
/** Which parts the engine is built of: section [Slam]. */
struct TSlamOptions
{
	std::string node_decider{"CDistanceNRD"};
	std::string edge_deciders{"CSequentialStereoERD CRoiStereoERD"};
	std::string optimizer{"CSparseGSO"};
	int threads{2};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.text("node_decider", node_decider, "Node registration decider (see --list-deciders)");
		v.text(
			"edge_deciders", edge_deciders, "Edge registration deciders, blank-separated, run in this order");
		v.text("optimizer", optimizer, "Optimiser of the graph (see --list-deciders)");
		v.integer(
			"threads", threads, between(1, 64),
			"Threads that verify candidates; results do not depend on it");
	}
};

/** Section [NodeRegistrationDeciderParameters]. */
struct TNodeOptions
{
	double distance{0.5};  ///< [m]

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"distance", distance, above(0), "A node each so many metres of 3D displacement (paper sec. 3.2)");
	}
};

/** Section [SequentialEdges]. */
struct TSequentialOptions
{
	int neighbours{4};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.integer("neighbours", neighbours, between(1, 100), "Stereo edges to so many previous nodes");
	}
};

/** Section [EdgeRegistrationDeciderParameters]: the paper's loop closings. */
struct TRoiOptions
{
	double radius{8.0};	 ///< [m]
	double sigmas{3.0}, radius_max{20.0};
	int max_candidates{25};
	int min_node_gap{5};
	double min_overlap{0.35};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"roi_radius", radius, above(0),
			"Candidates: nodes in this sphere round the present pose [m] (paper sec. 3.2)");
		v.number(
			"roi_sigmas", sigmas, atLeast(0),
			"The sphere grows to so many sigmas of the pair's predicted distance, and the overlap is that of "
			"the best place within them; 0: constant");
		v.number("roi_radius_max", radius_max, above(0), "The sphere grows to this radius at most [m]");
		v.integer(
			"max_candidates", max_candidates, atLeast(1),
			"Registrations a node at most, best predicted overlap first");
		v.integer(
			"min_node_gap", min_node_gap, atLeast(1), "Leave out nodes fewer than this many steps back");
		v.number(
			"min_overlap", min_overlap, between(0, 1),
			"Leave out pairs whose pictures are predicted to share less");
	}
};

/** Section [LoopGate]: is a registration believed? */
struct TGateOptions
{
	std::string kind{"mahalanobis"};
	double confidence{0.999};
	double max_jump{10};										   ///< [m]
	double sigma_floor_xyz{0.02};								   ///< [m]
	double sigma_floor_angle{0.5 * 3.14159265358979323846 / 180};  ///< [rad]
	double retry_moved{0.5};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice(
			"gate", kind, {"mahalanobis", "jump"},
			"mahalanobis: chi-square against the graph's own prediction; jump: the paper's authors' distance "
			"limit");
		v.number(
			"gate_confidence", confidence, between(0.5, 0.999999999),
			"Share of true registrations that pass");
		v.number(
			"max_jump", max_jump, above(0),
			"jump: largest difference to the prediction [m] (authors' code: 10)");
		v.number(
			"sigma_floor_xyz", sigma_floor_xyz, atLeast(0),
			"Least sigma of a predicted translation axis [m]");
		v.degrees(
			"sigma_floor_angle", sigma_floor_angle, atLeast(0),
			"Least sigma of a predicted rotation axis [deg]");
		v.number(
			"retry_moved", retry_moved, atLeast(0),
			"mahalanobis: a refused pair is judged again once its prediction has moved so many sigmas; 0: "
			"never");
	}
};

/** Section [GraphOptimizer]: what the stereo edges weigh in CSparseGSO. */
struct TGraphLossOptions
{
	std::string loss{"cauchy"};
	double scale{4.0};
	bool share_information{true};
	bool incremental{true};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice("loss", loss, {"none", "huber", "cauchy"}, "Robust loss of the stereo edges");
		v.number(
			"loss_scale", scale, above(0), "Mahalanobis distance where the loss departs from quadratic [-]");
		v.flag(
			"incremental", incremental,
			"Eliminates only what a new node changes; false: the whole graph, after each");
		v.flag(
			"share_information", share_information,
			"Stereo edges made of the same points share their information; false: taken as independent");
	}
};

/** Section [Priors]: what enters the graph beside increments and registrations (README, "Priors"). */
struct TPriorOptions
{
	bool root{true}, depth{true}, roll_pitch{true}, heading{true}, position{true};

	static TPriorOptions none() { return {false, false, false, false, false}; }

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.flag("root", root, "The first node is held with the filter's covariance there; false: it is fixed");
		v.flag("depth", depth, "Measured depths");
		v.flag("roll_pitch", roll_pitch, "Measured roll and pitch");
		v.flag("heading", heading, "Measured headings");
		v.flag("position", position, "GPS fixes");
	}
};

/** Section [OptimizerParameters]: what MRPT's own CLevMarqGSO reads, when it is chosen for comparison. */
struct TLevMarqOptions
{
	double optimization_distance{-1};
	int lc_min_nodeid_diff{30};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"optimization_distance", optimization_distance, anyNumber(),
			"CLevMarqGSO: only nodes so near [m]; -1: all");
		v.integer(
			"LC_min_nodeid_diff", lc_min_nodeid_diff, atLeast(1),
			"CLevMarqGSO: node-id gap of a loop closing");
	}
};
}  // namespace posidonia
