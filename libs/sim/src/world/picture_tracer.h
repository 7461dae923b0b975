#pragma once

#include <posidonia/sim/flat_port.h>

#include <vector>

#include "height_surface.h"
#include "ray_tracer.h"

namespace posidonia
{
/** Ranges of a whole picture. Embree traces the corners of blocks of 4 x 4 pixels. Where the depths of the
 * corners bend little the block sees one smooth piece of floor: its pixels start from the corners' inverse
 * depth, which is linear over a plane, and Newton's method finds where each ray meets its triangle. All
 * other pixels - edges of boulders, what lies behind them, the horizon - are traced. */
class CPictureTracer
{
   public:
	CPictureTracer(
		const CHeightSurface& surface, const CRayTracer& tracer, const TViewRays& rays,
		const Eigen::Isometry3d& T_map_camera);
	cv::Mat1f ranges();

   private:
	static constexpr int kBlock = 4;		///< [px]
	static constexpr float kBend = 0.01f;	///< Second difference of inverse depth that is an edge, relative
	static constexpr float kClose = 2e-5f;	///< A ray ends this near to its triangle [m]
	static constexpr int kSteps = 3;		///< Of Newton's method

	size_t pixel(int u, int v) const
	{
		return static_cast<size_t>(v) * static_cast<size_t>(m_rays.width) + static_cast<size_t>(u);
	}
	Eigen::Vector3f originOf(size_t i) const;
	Eigen::Vector3f directionOf(size_t i) const;
	void queue(size_t i);  ///< For trace()
	void trace();		   ///< Those queued, 16 at a time
	void traceCorners();
	void findEdges();
	bool bends(int i, int j) const;
	void fillBlock(int i, int j);
	void fillSmooth(int i, int j);
	float refined(size_t i, float range) const;

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
};
}  // namespace posidonia
