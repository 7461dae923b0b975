#pragma once

#include <posidonia/eval/association.h>
#include <posidonia/eval/statistics.h>

namespace posidonia
{
struct TRelativeErrorOptions
{
	double delta{10};
	std::string unit{"m"};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("rpe_delta", delta, above(0), "Length of the pieces whose error is measured, in rpe_unit");
		v.choice("rpe_unit", unit, {"m", "frames"}, "Metres along the truth, or associated poses (rounded)");
	}
};

/** Relative pose error: E = (T_truth_i^-1 T_truth_j)^-1 (T_est_i^-1 T_est_j), needs no alignment. */
struct TRelativeError
{
	TStatistics translation;  ///< |trans(E)| [m]
	TStatistics rotation;	  ///< angle of E [rad]
	TStatistics drift;		  ///< |trans(E)| over the metres travelled by the truth between i and j
};

/** From every pose i to the first pose j at least `delta` further along (pieces overlap, as KITTI's).
 * Counts are 0 when the run is shorter than delta. */
TRelativeError relativeError(const TAssociation& poses, const TRelativeErrorOptions& options = {});
}  // namespace posidonia
