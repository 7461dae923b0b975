#include "height_surface.h"

namespace posidonia
{
CHeightSurface::CHeightSurface(const TDepthGrid& grid)
	: m_grid{grid.depth.clone(), grid.resolution},
	  m_gradient(grid.depth.size()),
	  m_per_metre(static_cast<float>(1 / grid.resolution)),
	  m_centre_col(static_cast<float>(grid.depth.cols - 1) / 2),
	  m_centre_row(static_cast<float>(grid.depth.rows - 1) / 2),
	  m_last_col(std::nextafter(static_cast<float>(grid.depth.cols - 1), 0.0f)),
	  m_last_row(std::nextafter(static_cast<float>(grid.depth.rows - 1), 0.0f)),
	  m_stride(static_cast<ptrdiff_t>(m_grid.depth.step1()))
{
	const int cols = grid.depth.cols, rows = grid.depth.rows;
	for (int j = 0; j < rows; j++)
		for (int i = 0; i < cols; i++) {
			const int west = std::max(i - 1, 0), east = std::min(i + 1, cols - 1);
			const int north = std::max(j - 1, 0), south = std::min(j + 1, rows - 1);
			m_gradient(j, i) = {
				(grid.depth(north, i) - grid.depth(south, i)) * m_per_metre /
					static_cast<float>(south - north),
				(grid.depth(j, east) - grid.depth(j, west)) * m_per_metre / static_cast<float>(east - west)};
		}
}

Eigen::Vector2f CHeightSurface::smoothGradient(float north, float east) const
{
	const float x = clamped(m_centre_col + east * m_per_metre, m_last_col);
	const float y = clamped(m_centre_row - north * m_per_metre, m_last_row);
	const int i = static_cast<int>(x), j = static_cast<int>(y);
	const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
	const cv::Vec2f *p = m_gradient.ptr<cv::Vec2f>(j) + i, *q = m_gradient.ptr<cv::Vec2f>(j + 1) + i;
	const cv::Vec2f g = (p[0] * (1 - fx) + p[1] * fx) * (1 - fy) + (q[0] * (1 - fx) + q[1] * fx) * fy;
	return {g[0], g[1]};
}
}  // namespace posidonia
