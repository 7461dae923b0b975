#pragma once

#include <posidonia/nav/ekf_options.h>

#include <Eigen/Dense>

namespace posidonia
{
/** Where a vehicle's own drag takes its velocity when nobody measures it: the thrust along surge stays what
 * it was when bottom lock was lost, nothing drives sway and heave; m dv/dt = thrust - d1 v - d2 v|v| on each
 * axis (SPARUS II has no sway thruster). */
class CDragModel
{
   public:
	explicit CDragModel(const TDragOptions& options) : m_options(options) {}

	/** From now on, at `velocity` over ground in body axes [m/s]. */
	void start(const Eigen::Vector3d& velocity);
	/** The velocity dt [s] later. */
	void advance(double dt);
	const Eigen::Vector3d& velocity() const { return m_velocity; }
	/** Sigma of one of the pseudo-readings that come every `period` [s], each axis [m/s]: the model's error
	 * lasts for the correlation time, so readings are told as weak as makes their mean as uncertain as that
	 * of the correlated ones. */
	Eigen::Vector3d sigmaOfReading(double period) const;

   private:
	TDragOptions m_options;
	Eigen::Vector3d m_velocity{0, 0, 0};
	double m_thrust{0};	 ///< Along surge [N]
};
}  // namespace posidonia
