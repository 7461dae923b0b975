#pragma once

namespace posidonia
{
/** A set-point that moves: value and derivatives. */
struct TReference
{
	double value{0}, rate{0}, acceleration{0};
};

/** A turn on the spot: the heading by a minimum-jerk step (Flash and Hogan 1985), whose rate and acceleration
 * are zero at both ends. */
class CTurnProfile
{
   public:
	CTurnProfile() = default;
	/** From heading `from` over `angle` [rad]; as fast as peak rate [rad/s] and acceleration [rad/s^2] allow.
	 */
	CTurnProfile(double from, double angle, double peak_rate, double peak_acceleration);
	double duration() const { return m_duration; }	///< [s]
	TReference at(double t) const;

   private:
	double m_from{0}, m_angle{0}, m_duration{0};
};

/** A value that follows a target with bounded rate and acceleration, without overshoot of a target that
 * stands. */
class CSmoothReference
{
   public:
	void reset(double value) { m_now = {value, 0, 0}; }
	const TReference& update(double target, double max_rate, double max_acceleration, double dt);
	const TReference& now() const { return m_now; }

   private:
	TReference m_now;
};
}  // namespace posidonia
