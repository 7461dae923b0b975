#pragma once

#include <posidonia/sim/relief.h>

#include "row_kernels.h"

namespace posidonia
{
/** The triangles of a depth grid, each cell cut from its north-east to its south-west corner as Embree cuts
 * the quads of a grid, and their smoothed slopes. Beyond the grid its border goes on. */
class CHeightSurface
{
   public:
	explicit CHeightSurface(const TDepthGrid& grid);

	TGridView depth() const { return viewOf(m_grid.depth); }
	/** d depth / d north, d depth / d east: central differences at the grid's points. */
	TGridView perNorth() const { return viewOf(m_per_north); }
	TGridView perEast() const { return viewOf(m_per_east); }

   private:
	TGridView viewOf(const cv::Mat1f& grid) const;
	TDepthGrid m_grid;
	cv::Mat1f m_per_north, m_per_east;
};
}  // namespace posidonia
