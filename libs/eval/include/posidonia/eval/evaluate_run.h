#pragma once

#include <posidonia/eval/absolute_error.h>
#include <posidonia/eval/metrics.h>
#include <posidonia/eval/relative_error.h>

namespace posidonia
{
struct TEvaluationOptions
{
	TAssociationOptions association;
	TRelativeErrorOptions relative;

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		association.visit(v);
		relative.visit(v);
	}
};

/** Everything about one trajectory against the truth. Lengths are by chords [m]. */
struct TRunEvaluation
{
	TAssociation poses;
	std::vector<TAbsoluteError> absolute;  ///< in the order of kAlignments: [0] is unaligned
	TRelativeError relative;
	double length{0};		 ///< of the estimate, over the associated poses
	double truth_length{0};	 ///< of the truth at the same stamps: compares with `length`
	double truth_length_full{
		0};			   ///< of the truth at its own rate, between the first and last associated stamps
	TMetrics metrics;  ///< all of it, as rows "<prefix>...."
};

/** @param prefix of the rows' names: "nodes", "slam", "odom" ...
 * Throws CError when nothing can be associated, or stamps go backwards. */
TRunEvaluation evaluateRun(
	const std::string& prefix, const TTrajectory& estimate, const TTrajectory& truth,
	const TEvaluationOptions& options = {});
}  // namespace posidonia
