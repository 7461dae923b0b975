#pragma once

#include <posidonia/sim/relief.h>

#include <Eigen/Dense>
#include <memory>

namespace posidonia
{
/** Rays against the triangles of a depth grid and of the level border that goes on around it: Embree 3, with
 * its robust intersection (without it rays slip through between triangles). */
class CRayTracer
{
   public:
	explicit CRayTracer(const TDepthGrid& grid);
	~CRayTracer();

	/** Up to 16 rays [m, map]; directions are unit vectors. */
	struct TPacket
	{
		int count{0};
		float origin[3][16], direction[3][16];
		float range[16];  ///< What trace() finds [m]; infinite: nothing
		void add(const Eigen::Vector3f& from, const Eigen::Vector3f& along);
		bool full() const { return count == 16; }
	};
	void trace(TPacket& packet) const;

   private:
	struct TEmbree;
	std::unique_ptr<const TEmbree> m_embree;
};
}  // namespace posidonia
