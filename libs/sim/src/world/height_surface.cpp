#include "height_surface.h"

#include <cmath>

namespace posidonia
{
CHeightSurface::CHeightSurface(const TDepthGrid& grid)
	: m_grid{grid.depth.clone(), grid.resolution},
	  m_per_north(grid.depth.size()),
	  m_per_east(grid.depth.size())
{
	const cv::Mat1f& depth = m_grid.depth;
	const float per_metre = static_cast<float>(1 / grid.resolution);
	for (int j = 0; j < depth.rows; j++)
		for (int i = 0; i < depth.cols; i++) {
			const int west = std::max(i - 1, 0), east = std::min(i + 1, depth.cols - 1);
			const int north = std::max(j - 1, 0), south = std::min(j + 1, depth.rows - 1);
			m_per_north(j, i) =
				(depth(north, i) - depth(south, i)) * per_metre / static_cast<float>(south - north);
			m_per_east(j, i) =
				(depth(j, east) - depth(j, west)) * per_metre / static_cast<float>(east - west);
		}
}

TGridView CHeightSurface::viewOf(const cv::Mat1f& grid) const
{
	const float cols = static_cast<float>(grid.cols - 1), rows = static_cast<float>(grid.rows - 1);
	return {
		grid.ptr<float>(),
		static_cast<int>(grid.step1()),
		static_cast<float>(1 / m_grid.resolution),
		cols / 2,
		rows / 2,
		std::nextafter(cols, 0.0f),
		std::nextafter(rows, 0.0f)};
}
}  // namespace posidonia
