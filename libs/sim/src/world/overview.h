#pragma once

#include <posidonia/sim/floor.h>
#include <posidonia/sim/sea_floor.h>

namespace posidonia
{
/** The world from above, north up, CV_8UC3: the texture with relief shading (light from the north-west) and
 * contour lines, a scale bar, and a way [m, map] in red with its start as a dot. At most 1600 pixels a side.
 */
cv::Mat overviewOf(
	const CFloorTexture& texture, const CSeaFloor& floor, const std::vector<Eigen::Vector3d>& way);
}  // namespace posidonia
