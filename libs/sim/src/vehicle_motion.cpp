#include <posidonia/geometry/se3.h>
#include <posidonia/sim/random.h>
#include <posidonia/sim/vehicle_motion.h>

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

CRipple::CRipple(const TMotionOptions& o, uint64_t seed) : m_fade_in(o.fade_in)
{
	const double largest[CHANNELS] = {o.sway, o.sway, o.heave, o.roll, o.pitch, o.yaw};
	CNoise noise(seedOf(seed, "motion"));
	for (int channel = 0; channel < CHANNELS; channel++)
		for (int i = 0; i < kWaves; i++) {
			// Periods about 0.6, 1 and 1.7 of the middle one, never in a simple ratio.
			const double period = o.period * std::pow(1.7, i - 1) * noise.uniform(0.85, 1.15);
			m_waves[channel][i] = {largest[channel] / kWaves, 2 * M_PI / period, noise.uniform(0, 2 * M_PI)};
		}
}

TProfileValue CRipple::at(EChannel channel, double t) const
{
	TProfileValue sum;
	for (const TWave& w : m_waves[channel]) {
		const double s = w.amplitude * std::sin(w.frequency * t + w.phase);
		const double c = w.amplitude * std::cos(w.frequency * t + w.phase);
		sum.value += s;
		sum.rate += w.frequency * c;
		sum.acceleration -= w.frequency * w.frequency * s;
	}
	const TProfileValue fade = minimumJerkStep(t, m_fade_in);  // product rule
	return {
		fade.value * sum.value, fade.rate * sum.value + fade.value * sum.rate,
		fade.acceleration * sum.value + 2 * fade.rate * sum.rate + fade.value * sum.acceleration};
}

CVehicleMotion::CVehicleMotion(const TRouteOptions& route, const TMotionOptions& motion, uint64_t seed)
	: m_plan(route), m_ripple(motion, seed)
{
}

namespace
{
/** Body rates of yaw-pitch-roll with their first two derivatives (Fossen 2011, eq. 2.26, and its derivative).
 */
void setAttitude(
	const TProfileValue& yaw, const TProfileValue& pitch, const TProfileValue& roll, TVehicleState& s)
{
	const double sr = std::sin(roll.value), cr = std::cos(roll.value);
	const double sp = std::sin(pitch.value), cp = std::cos(pitch.value);
	s.T_map_body.linear() = rotationFromYawPitchRoll(yaw.value, pitch.value, roll.value);
	s.omega_body << roll.rate - yaw.rate * sp, pitch.rate * cr + yaw.rate * sr * cp,
		-pitch.rate * sr + yaw.rate * cr * cp;
	// d/dt of the three lines above
	s.alpha_body.x() = roll.acceleration - yaw.acceleration * sp - yaw.rate * pitch.rate * cp;
	s.alpha_body.y() = pitch.acceleration * cr - pitch.rate * roll.rate * sr + yaw.acceleration * sr * cp +
					   yaw.rate * (roll.rate * cr * cp - pitch.rate * sr * sp);
	s.alpha_body.z() = -pitch.acceleration * sr - pitch.rate * roll.rate * cr + yaw.acceleration * cr * cp -
					   yaw.rate * (roll.rate * sr * cp + pitch.rate * cr * sp);
}
}  // namespace

TVehicleState CVehicleMotion::at(double t) const
{
	TPlannedState plan = m_plan.at(t);
	for (int i = 0; i < 3; i++) {
		const TProfileValue r = m_ripple.at(static_cast<CRipple::EChannel>(i), t);
		plan.position[i] += r.value, plan.velocity[i] += r.rate, plan.acceleration[i] += r.acceleration;
	}
	TProfileValue yaw = m_ripple.at(CRipple::YAW, t);
	yaw.value += plan.heading.value, yaw.rate += plan.heading.rate,
		yaw.acceleration += plan.heading.acceleration;

	TVehicleState state;
	state.t = t;
	setAttitude(yaw, m_ripple.at(CRipple::PITCH, t), m_ripple.at(CRipple::ROLL, t), state);
	state.T_map_body.translation() = plan.position;
	state.v_map = plan.velocity;
	state.v_body = state.T_map_body.linear().transpose() * plan.velocity;
	state.a_map = plan.acceleration;
	return state;
}
}  // namespace posidonia
