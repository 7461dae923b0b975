#pragma once

#include <posidonia/sim/relief.h>
#include <posidonia/sim/sea_floor.h>

#include <memory>

namespace posidonia
{
/** A height field of triangles. Beyond its grid the border goes on, level across it, without an end.
 * Ranges by Embree (Wald et al. 2014); the surface between grid points is that of its triangles, exactly. */
class CReliefSeaFloor : public CSeaFloor
{
   public:
	explicit CReliefSeaFloor(const TDepthGrid& grid);
	~CReliefSeaFloor() override;

	double depthAt(const Eigen::Vector2d& north_east) const override;
	double rangeAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const override;
	void gradientsAt(const std::vector<float>& north, const std::vector<float>& east, TGradients& gradients)
		const override;
	/** Whole pictures: some rays by Embree, those between them by Newton's method from their neighbours'. */
	cv::Mat1f rangesAlong(const TViewRays& rays, const Eigen::Isometry3d& T_map_camera) const override;

   private:
	struct TShape;
	std::unique_ptr<const TShape> m_shape;
};
}  // namespace posidonia
