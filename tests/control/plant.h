#pragma once

#include <posidonia/control/autopilot.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace posidonia::testing
{
/** A small SPARUS II of the tests: surge, sway, heave and yaw through moving water (Fossen), added mass,
 * linear and quadratic drag, thrusters with first-order lag. Numbers: design of libs/control, Toulon's model.
 */
class CPlant
{
   public:
	Eigen::Vector2d current{0, 0};	///< North east [m/s]
	Eigen::Vector3d position{0, 0, 0};
	double heading{0};
	double buoyancy{0.98};	///< Upwards [N]
	Eigen::Vector3d efficiency{1, 1, 1};

	explicit CPlant(const TAllocationOptions& thrusters = {}) : m_law(thrusters) {}

	/** Moves on with these set-points for `duration` [s], in steps of 10 ms. */
	void advance(const TThrusters& set_points, double duration)
	{
		for (int i = 0, n = static_cast<int>(std::lround(duration / 0.01)); i < n; i++)
			step(m_law.thrustsOf(set_points), 0.01);
	}

	TControlState state(double stamp) const
	{
		TControlState s;
		s.stamp = stamp;
		s.T_map_body.linear() = rotationFromYawPitchRoll(heading, 0, 0);
		s.T_map_body.translation() = position;
		const Eigen::Vector2d water = Eigen::Rotation2Dd(-heading) * current;
		s.v_body = Eigen::Vector3d(m_u + water.x(), m_v + water.y(), m_w);
		s.omega_body = Eigen::Vector3d(0, 0, m_r);
		s.valid = true;
		return s;
	}

   private:
	void step(const TThrusters& wanted, double dt)
	{
		m_thrust.starboard += dt / 0.8 * (efficiency[0] * wanted.starboard - m_thrust.starboard);
		m_thrust.port += dt / 0.8 * (efficiency[1] * wanted.port - m_thrust.port);
		m_thrust.heave += dt / 0.4 * (efficiency[2] * wanted.heave - m_thrust.heave);
		const TWrench tau = m_law.wrench(m_thrust);
		const double mu = 54.1, mv = 122.4, mw = 121.2, iz = 26.7;
		const double u = m_u, v = m_v, w = m_w, r = m_r;
		m_u += dt * (tau.X - drag(u, 8, 36.4) + mv * v * r) / mu;
		m_v += dt * (-drag(v, 30, 96) - mu * u * r) / mv;
		m_w += dt * (tau.Z - buoyancy - drag(w, 30, 89)) / mw;
		m_r += dt * (tau.N - drag(r, 5, 15) + (mu - mv) * u * v) / iz;
		position.head<2>() += dt * (Eigen::Rotation2Dd(heading) * Eigen::Vector2d(m_u, m_v) + current);
		position.z() = std::max(0.0, position.z() + dt * m_w);
		heading += dt * m_r;
	}
	static double drag(double x, double linear, double quadratic)
	{
		return linear * x + quadratic * x * std::abs(x);
	}

	CThrusterAllocation m_law;
	TThrusters m_thrust;
	double m_u{0}, m_v{0}, m_w{0}, m_r{0};	///< Through the water
};

/** What a run left. */
struct TRun
{
	std::vector<TAutopilotOutput> outputs;
	std::vector<TControlState> states;
	std::vector<TMissionEvent> events;
	bool finished{false};

	int count(EMissionEvent kind) const
	{
		return static_cast<int>(std::count_if(
			events.begin(), events.end(), [&](const TMissionEvent& e) { return e.kind == kind; }));
	}
};

/** Called before each step; may change plant, navigation and health (faults). */
using TFault = std::function<void(double t, CPlant&, TControlState&, TVehicleHealth&)>;

/** Runs a mission in closed loop at 10 Hz until it is finished, and `after` seconds on, for `longest` [s] at
 * most. */
inline TRun runMission(
	CPlant& plant, const TAutopilotOptions& options, const TMission& mission, double longest,
	double after = 0, const TFault& fault = {})
{
	TRun run;
	CAutopilot autopilot(options, mission);
	double until = longest;
	for (int i = 0; 0.1 * i <= until; i++) {
		const double t = 0.1 * i;
		TControlState state = plant.state(t);
		TVehicleHealth health;
		health.stamp = health.mission_time = t;
		if (fault) fault(t, plant, state, health);
		run.states.push_back(state);
		run.outputs.push_back(autopilot.step(state, health));
		const auto& out = run.outputs.back();
		run.events.insert(run.events.end(), out.events.begin(), out.events.end());
		if (out.finished && !run.finished) until = std::min(until, t + after);
		run.finished = run.finished || out.finished;
		plant.advance(out.set_points, 0.1);
	}
	return run;
}

inline TStep legTo(double north, double east, double depth)
{
	TStep step;
	step.kind = EStepKind::SECTION;
	step.name = "leg";
	step.end = {north, east};
	step.has_end = true;
	step.depth = depth;
	return step;
}

inline TStep holdFor(double duration, double depth)
{
	TStep step;
	step.kind = EStepKind::HOLD;
	step.name = "hold";
	step.duration = duration;
	step.depth = depth;
	return step;
}

inline TStep diveTo(double depth)
{
	TStep step;
	step.kind = EStepKind::DIVE;
	step.name = "dive";
	step.depth = depth;
	return step;
}

inline TMission missionOf(const std::vector<TStep>& steps)
{
	TMission mission;
	mission.steps = steps;
	return mission;
}
}  // namespace posidonia::testing
