#pragma once

#include <posidonia/base/options.h>
#include <posidonia/eval/footprint.h>
#include <posidonia/eval/loops_file.h>
#include <posidonia/eval/metrics.h>
#include <posidonia/eval/statistics.h>

#include <map>

namespace posidonia
{
struct TLoopEvaluationOptions
{
	double max_translation_error{0.3};
	double max_rotation_error{0.08726646259971647};
	double min_overlap{0.5};
	int min_node_gap{10};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"loop_max_translation_error", max_translation_error, above(0),
			"An edge further from the truth is false [m]");
		v.degrees(
			"loop_max_rotation_error", max_rotation_error, {0, 180, true},
			"An edge further from the truth is false [deg]");
		v.number(
			"loop_min_overlap", min_overlap, between(0, 1),
			"A pair of nodes should close a loop when their true footprints overlap by more than this");
		v.integer(
			"loop_min_node_gap", min_node_gap, atLeast(1),
			"Pairs of nodes count as loops when their ids differ by more than this");
	}
};

/** How the accepted edges of one sort compare with the truth. */
struct TEdgeQuality
{
	int accepted{0};		  ///< accepted rows whose nodes have a true pose
	int wrong{0};			  ///< of these, false edges
	TStatistics translation;  ///< error of the accepted [m]
	TStatistics rotation;	  ///< error of the accepted [rad]

	/** Right ones among the accepted; none accepted: no value. */
	std::optional<double> precision() const;
};

/** Precision by rows; recall by pairs of nodes: a pair counts once, whatever its direction and number of
 * rows. */
struct TLoopEvaluation
{
	TEdgeQuality loops;		  ///< every kind but "sequential" and "odometry"
	TEdgeQuality sequential;  ///< kind "sequential"
	int without_truth{0};	  ///< rows with a node that has no true pose: not judged

	int overlapping{0};		   ///< pairs further apart than min_node_gap whose true footprints overlap enough
	int overlapping_tried{0};  ///< of these, offered to registration (listed, not "over budget")
	int overlapping_found{0};  ///< of these, accepted and right
	std::map<std::string, int> statuses;  ///< loop rows by status

	std::optional<double> recallOfTried() const;  ///< overlapping_found / overlapping_tried
	std::optional<double> recallOfAll() const;	  ///< overlapping_found / overlapping
};

/** @param T_map_body true body poses by node id, at the nodes' stamps */
TLoopEvaluation evaluateLoops(
	const std::vector<TLoopRow>& rows, const std::map<std::uint64_t, Eigen::Isometry3d>& T_map_body,
	const TFootprintCamera& camera, const TLoopEvaluationOptions& options = {});

/** Rows "<prefix>.accepted", "<prefix>.precision", "<prefix>.recall_of_tried" ...; a ratio with nothing below
 * the line has no row. */
TMetrics loopMetrics(const std::string& prefix, const TLoopEvaluation& evaluation);
}  // namespace posidonia
