#pragma once

#include <posidonia/sim/relief.h>

#include <Eigen/Dense>

namespace posidonia
{
/** The triangles of a depth grid as functions of (north, east): each cell is cut from its north-east to its
 * south-west corner, as Embree cuts the quads of a grid. Beyond the grid its border goes on. */
class CHeightSurface
{
   public:
	explicit CHeightSurface(const TDepthGrid& grid);

	/** Depth [m] and its slope on the triangle at (north, east) [m]. */
	struct TPoint
	{
		float depth, per_north, per_east;
	};
	TPoint at(float north, float east) const
	{
		const float x = clamped(m_centre_col + east * m_per_metre, m_last_col);
		const float y = clamped(m_centre_row - north * m_per_metre, m_last_row);
		const int i = static_cast<int>(x), j = static_cast<int>(y);
		const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
		const float *p = m_grid.depth.ptr<float>(j) + i, *q = p + m_stride;
		const bool first = fx + fy <= 1;
		const float along_col = first ? p[1] - p[0] : q[1] - q[0];
		const float along_row = first ? q[0] - p[0] : q[1] - p[1];
		const float depth = first ? p[0] + fx * along_col + fy * along_row
								  : q[1] - (1 - fx) * along_col - (1 - fy) * along_row;
		return {depth, -along_row * m_per_metre, along_col * m_per_metre};
	}
	/** d depth / d (north, east), smooth: central differences at the grid's points, bilinear between. */
	Eigen::Vector2f smoothGradient(float north, float east) const;
	const TDepthGrid& grid() const { return m_grid; }

   private:
	static float clamped(float x, float last) { return std::min(std::max(x, 0.0f), last); }

	TDepthGrid m_grid;
	cv::Mat2f m_gradient;  ///< (north, east) at the grid's points
	float m_per_metre, m_centre_col, m_centre_row, m_last_col, m_last_row;
	ptrdiff_t m_stride;
};
}  // namespace posidonia
