#pragma once

#include <Eigen/Dense>

namespace posidonia
{
/** The shape of the sea floor, in map. Const and thread-safe. */
class CSeaFloor
{
   public:
	virtual ~CSeaFloor() = default;
	/** Depth of the floor [m, down] below the point (north, east) [m]. */
	virtual double depthAt(const Eigen::Vector2d& north_east) const = 0;
	/** Distance [m] from `origin` [m, map] along the unit vector `direction` to the floor; infinite where the
	 * ray does not meet it. */
	virtual double rangeAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const = 0;
};

/** A level plane without an end. */
class CFlatSeaFloor : public CSeaFloor
{
   public:
	/** `depth` [m], down. */
	explicit CFlatSeaFloor(double depth) : m_depth(depth) {}
	double depthAt(const Eigen::Vector2d&) const override { return m_depth; }
	double rangeAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const override;

   private:
	double m_depth;
};
}  // namespace posidonia
