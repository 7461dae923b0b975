#pragma once

#include <posidonia/base/options.h>

#include <string>

namespace posidonia
{
/** How two key frames are registered (README, sections 3 to 6). */
struct TRegistrationOptions
{
	double match_ratio{0.9};
	int min_matches{15};
	std::string ransac{"USAC_MSAC"};
	double ransac_threshold{3.0};  ///< [px]
	double ransac_confidence{0.999};
	int ransac_iterations{2000};
	unsigned ransac_seed{1};
	double point_cutoff{32};  ///< [sigma^2]
	int min_inliers{15};
	double max_rmse{2.0};	///< [px]
	double min_spread{20};	///< [px]
	bool canonical_order{true};
	bool scale_by_residuals{true};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("match_ratio", match_ratio, between(0.1, 1), "Ratio test between key frames; 1 = off");
		v.integer("min_matches", min_matches, atLeast(6), "Fewest reciprocal matches");
		v.choice("ransac", ransac, {"USAC_MSAC", "USAC_MAGSAC"}, "Score of the PnP RANSAC");
		v.number("ransac_threshold", ransac_threshold, above(0), "RANSAC inlier threshold [px]");
		v.number("ransac_confidence", ransac_confidence, between(0.5, 0.999999), "RANSAC confidence");
		v.integer("ransac_iterations", ransac_iterations, between(1, 1000000), "RANSAC iterations at most");
		v.seed("ransac_seed", ransac_seed, "Seed of RANSAC");
		v.number(
			"point_cutoff", point_cutoff, above(0),
			"Tukey cut-off of a point's chi2 [sigma^2]; inliers are below half");
		v.integer("min_inliers", min_inliers, atLeast(6), "Fewest inliers of an accepted registration");
		v.number("max_rmse", max_rmse, above(0), "Largest reprojection RMSE [px]");
		v.number(
			"min_spread", min_spread, atLeast(0),
			"Least spread of the inliers along their narrower axis [px]");
		v.flag("canonical_order", canonical_order, "Solve a pair in one direction, whichever is asked for");
		v.flag(
			"scale_by_residuals", scale_by_residuals,
			"Where the residuals are larger than the stated noise, the information is smaller in proportion");
	}
};
}  // namespace posidonia
