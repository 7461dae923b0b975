#include <posidonia/base/error.h>
#include <posidonia/vision/feature_options.h>

namespace posidonia
{
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
