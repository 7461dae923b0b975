#pragma once

#include <posidonia/sim/flat_port.h>

#include <cmath>
#include <vector>

#include "height_surface.h"
#include "ray_tracer.h"

namespace posidonia
{
/** Ranges of a whole picture. Embree traces the corners of blocks of 8 x 8 pixels. Where the depths of the
 * corners bend little the block sees one smooth piece of floor: its pixels start from the corners' inverse
 * depth, which is linear over a plane, and two steps of Newton's
 * method find where each ray meets its triangle. All
 * other pixels - edges of boulders, what lies behind them, the horizon - are traced. */
class CPictureTracer
{
   public:
	CPictureTracer(
		const CHeightSurface& surface, const CRayTracer& tracer, const TViewRays& rays,
		const Eigen::Isometry3d& T_map_camera);
	cv::Mat1f ranges();

   private:
	static constexpr int kBlock = 8;		///< [px]
	static constexpr float kBend = 0.005f;	///< Second difference of inverse depth that is an edge, relative
	static constexpr float kClose = 1e-4f;	///< A ray may miss its triangle by this before the last step [m]
	static constexpr float kGrazing = 0.05f;  ///< It must come this much nearer a metre

	size_t pixel(int u, int v) const
	{
		return static_cast<size_t>(v) * static_cast<size_t>(m_rays.width) + static_cast<size_t>(u);
	}
	void queue(size_t i);  ///< For trace()
	void trace();		   ///< Those queued, 16 at a time
	void traceCorners();
	void findEdges();
	bool bends(int i, int j) const;
	void fillRow(int v);
	/** Ranges that the corners of the blocks suggest; smooth blocks only, the others stay. */
	void guessRow(int v);
	bool smooth(int i, int j) const;
	/** Has the row's ray met its triangle? */
	bool met(size_t u) const
	{
		return std::abs(m_miss[u]) < kClose && m_rate[u] > kGrazing && m_range[u] > 0;
	}

	const CHeightSurface& m_surface;
	const CRayTracer& m_tracer;
	const TViewRays& m_rays;
	Eigen::Matrix3f m_R;
	Eigen::Vector3f m_centre;
	cv::Mat1f m_ranges;
	cv::Mat1f m_inverse;  ///< Inverse depth along the axis at the blocks' corners [1/m]; 0: nothing there
	cv::Mat1b m_edge;	  ///< Do the depths bend there?
	CRayTracer::TPacket m_packet;
	size_t m_queued[16];
	TPixelVectors m_from, m_along;				 ///< The rays of a row in map axes
	std::vector<float> m_range, m_miss, m_rate;	 ///< Of that row
};
}  // namespace posidonia
