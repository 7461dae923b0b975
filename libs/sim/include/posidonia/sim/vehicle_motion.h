#pragma once

#include <posidonia/sim/route.h>

#include <cstdint>

namespace posidonia
{
/** True motion of the body at an instant. */
struct TVehicleState
{
	double t{0};  ///< From the start [s]
	Eigen::Isometry3d T_map_body{Eigen::Isometry3d::Identity()};
	Eigen::Vector3d v_map{0, 0, 0};		  ///< [m/s]
	Eigen::Vector3d v_body{0, 0, 0};	  ///< The same velocity in body axes [m/s]
	Eigen::Vector3d omega_body{0, 0, 0};  ///< Body's angular rate in body axes [rad/s]
	Eigen::Vector3d a_map{0, 0, 0};		  ///< [m/s^2]
	Eigen::Vector3d alpha_body{0, 0, 0};  ///< d omega_body / dt [rad/s^2]
};

/** Section [Motion]: small smooth motion about the route, sums of sinusoids with seeded phases. */
struct TMotionOptions
{
	double roll{1.5 * M_PI / 180}, pitch{1.0 * M_PI / 180}, yaw{1.0 * M_PI / 180};
	double heave{0.03}, sway{0.02};
	double period{9}, fade_in{5};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.degrees("roll", roll, between(0, 30), "Largest roll [deg]");
		v.degrees("pitch", pitch, between(0, 30), "Largest pitch [deg]");
		v.degrees("yaw", yaw, between(0, 30), "Largest yaw off the route's heading [deg]");
		v.number("heave", heave, atLeast(0), "Largest vertical excursion [m]");
		v.number("sway", sway, atLeast(0), "Largest horizontal excursion, north and east each [m]");
		v.number("period", period, above(0), "Middle period of the sinusoids [s]");
		v.number("fade_in", fade_in, above(0), "The motion rises from zero in this time [s]");
	}
};

/** The small motion: a sum of three sinusoids a channel, faded in by a minimum-jerk step. */
class CRipple
{
   public:
	enum EChannel
	{
		NORTH,
		EAST,
		DOWN,
		ROLL,
		PITCH,
		YAW,
		CHANNELS
	};
	CRipple(const TMotionOptions& options, uint64_t seed);
	/** Excursion [m] or [rad] with derivatives. */
	TProfileValue at(EChannel channel, double t) const;

   private:
	static constexpr int kWaves = 3;
	struct TWave
	{
		double amplitude, frequency, phase;	 ///< [m or rad], [rad/s], [rad]
	};
	TWave m_waves[CHANNELS][kWaves];
	double m_fade_in;
};

/** The vehicle's true motion in closed form: route + small motion. */
class CVehicleMotion
{
   public:
	CVehicleMotion(const TRouteOptions& route, const TMotionOptions& motion, uint64_t seed);
	/** State at t [s] from the start; every derivative is analytic. */
	TVehicleState at(double t) const;
	const CRoutePlan& plan() const { return m_plan; }

   private:
	CRoutePlan m_plan;
	CRipple m_ripple;
};
}  // namespace posidonia
