#include <posidonia/base/error.h>
#include <posidonia/vision/feature_options.h>

#include <cmath>

namespace posidonia
{
namespace
{
/** Noise of the place that a detector gives to one spot of the floor in two views, a view [px]: measured once
 * over a procedural floor and a reef's photograph, all kinds of pairs (README, section 2). */
struct TMeasuredNoise
{
	double finest, growth;
};
TMeasuredNoise measuredNoise(const std::string& detector, int shrink)
{
	if (detector == "SIFT" && shrink > 1) return {0.078, 1.42};	 // 0.111 px at octave 1, the first there is
	if (detector == "SIFT") return {0.065, 1.42};
	if (detector == "ORB") return {0.33, 1.8};	// no sub-pixel position: uniform over a pixel of its level
	return {0.12, 1.5};
}
}  // namespace

double TFeatureOptions::positionSigma(double octave) const
{
	const TMeasuredNoise measured = measuredNoise(detector, shrink);
	return (sigma_uv > 0 ? sigma_uv : measured.finest) *
		   std::pow(sigma_uv_growth > 0 ? sigma_uv_growth : measured.growth, octave);
}

void TFeatureOptions::check() const
{
	if (detector != "SIFT" && detector != "ORB" && detector != "AKAZE")
		throw CError("detector = " + detector, "no such detector", "use SIFT, ORB or AKAZE");
	if (!(min_depth > 0 && max_depth > min_depth))
		throw CError(
			"min_depth = " + std::to_string(min_depth) + ", max_depth = " + std::to_string(max_depth),
			"no depth lies between them", "set max_depth above min_depth");
}
}  // namespace posidonia
