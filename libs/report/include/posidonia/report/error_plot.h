#pragma once

#include <posidonia/eval/absolute_error.h>

#include <string>
#include <vector>

namespace posidonia
{
/** The lower half of the paper's figure 5: 3D error [m] against the distance travelled along the truth [m].
 * Give the unaligned errors (absoluteError(poses, EAlignment::None)); empty ones are left out. */
struct TErrorPlot
{
	std::string title;
	std::vector<TPoseError> odometry, slam;
};

/** Throws CError when there is nothing to draw. */
std::string plotErrors(const TErrorPlot& plot);
}  // namespace posidonia
