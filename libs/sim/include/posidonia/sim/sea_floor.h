#pragma once

#include <posidonia/sim/flat_port.h>

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

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
	/** d depth / d north and d depth / d east, a number for each point. */
	struct TGradients
	{
		explicit TGradients(size_t n) : per_north(n), per_east(n) {}
		std::vector<float> per_north, per_east;
	};
	/** Those at points (north, east) [m], smooth from cell to cell: what light falls on. */
	virtual void gradientsAt(
		const std::vector<float>& north, const std::vector<float>& east, TGradients& gradients) const = 0;
	/** Its depth [m] where it is level everywhere, else empty. */
	virtual std::optional<double> levelDepth() const { return std::nullopt; }
	/** rangeAlong() of every pixel of a picture, from where its ray begins. */
	virtual cv::Mat1f rangesAlong(const TViewRays& rays, const Eigen::Isometry3d& T_map_camera) const;
};

/** A level plane without an end. */
class CFlatSeaFloor : public CSeaFloor
{
   public:
	/** `depth` [m], down. */
	explicit CFlatSeaFloor(double depth) : m_depth(depth) {}
	double depthAt(const Eigen::Vector2d&) const override { return m_depth; }
	double rangeAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const override;
	void gradientsAt(const std::vector<float>& north, const std::vector<float>& east, TGradients& gradients)
		const override;
	std::optional<double> levelDepth() const override { return m_depth; }

   private:
	double m_depth;
};
}  // namespace posidonia
