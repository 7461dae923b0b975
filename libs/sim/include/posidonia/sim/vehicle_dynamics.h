#pragma once

#include <posidonia/sim/current.h>
#include <posidonia/sim/thrusters.h>
#include <posidonia/sim/vehicle_motion.h>

namespace posidonia
{
/** The vehicle moved by its thrusters and the water: hull, thrusters and current, integrated by the classical
 * Runge-Kutta method of fourth order on SE(3) (Munthe-Kaas 1998: each step in the rotation vector from its
 * start), on a grid of whole steps from t = 0.
 *
 *   dynamics.advanceTo(bank.nextTime());
 *   bank.measure(dynamics.stateAt(bank.nextTime()));
 *
 * Nothing is allocated after the constructor; the same calls give the same bytes. */
class CVehicleDynamics
{
   public:
	/** Starts at rest over ground at `T_map_body`, thrusters stopped. `floor_depth` [m]; infinite: none.
	 * `seed`: of the gusts. Throws CError, with section and key, where the options make no vehicle. */
	CVehicleDynamics(
		const TVehicleOptions& vehicle, const TThrusterOptions& thrusters, const TCurrentOptions& current,
		double floor_depth, uint64_t seed, const Eigen::Isometry3d& T_map_body);

	/** Velocity over ground and angular rate, body axes [m/s], [rad/s], from now on. */
	void setVelocity(const Eigen::Vector3d& v_body, const Eigen::Vector3d& omega_body);
	/** Starboard, port, heave, -1 to 1 (clamped), from time() on. */
	void setSetPoints(const Eigen::Vector3d& set_points);
	/** Factors on the thrusts, 0 to 1 (a fault's). */
	void setEfficiency(const Eigen::Vector3d& factors) { m_thrusters.setEfficiency(factors); }
	/** Water's velocity on top of [Current]'s, map axes [m/s] (a fault's), instead of that set before. */
	void setAddedCurrent(const Eigen::Vector3d& v_map) { m_current.setAdded(time(), v_map); }

	/** To the last grid time not after t (a microsecond counts as not after: stamps are rounded). Throws
	 * CError when the motion has left the finite. */
	void advanceTo(double t);
	/** The grid time reached [s]. */
	double time() const { return static_cast<double>(m_steps) * m_step; }
	/** At a time within a step of time(); accelerations are the right-hand side of the equations there, not
	 * differences. Throws CError for another time. */
	TVehicleState stateAt(double t) const;

	const Eigen::Vector3d& thrusts() const { return m_motion.thrusts; }	 ///< Starboard, port, heave [N]
	/** Set-points in force, after saturation and rate limit. */
	Eigen::Vector3d setPoints() const { return m_thrusters.setPointsAt(time()); }
	/** Water's velocity at the vehicle, map axes [m/s]. */
	Eigen::Vector3d waterVelocity() const;
	const CHull& hull() const { return m_hull; }

   private:
	struct TMotion
	{
		Eigen::Isometry3d T_map_body;
		Vector6d nu;			  ///< Velocity and angular rate over ground, body axes
		Eigen::Vector3d thrusts;  ///< [N]
	};
	/** A step of TMotion, or its rate: position (map), rotation vector (body), nu, thrusts. */
	using step_t = Eigen::Matrix<double, 15, 1>;

	static TMotion moved(const TMotion& from, const step_t& step);
	step_t rate(double t, const step_t& step) const;
	TMotion integrated(double duration) const;

	CHull m_hull;
	CThrusters m_thrusters;
	CCurrent m_current;
	double m_step;
	uint64_t m_steps{0};
	TMotion m_motion;  ///< At time()
};
}  // namespace posidonia
