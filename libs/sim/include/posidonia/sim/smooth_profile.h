#pragma once

namespace posidonia
{
/** A value with its first and second time derivative. */
struct TProfileValue
{
	double value{0}, rate{0}, acceleration{0};
};

/** The minimum-jerk step from 0 at t = 0 to 1 at t = duration (Flash and Hogan 1985):
 * s = 10 x^3 - 15 x^4 + 6 x^5, x = t / duration; rate and acceleration are zero at both ends. */
TProfileValue minimumJerkStep(double t, double duration);

/** Peak of the step's rate times its duration: max ds/dx. */
inline constexpr double kMinimumJerkPeak = 1.875;

/** A straight leg from rest to rest: the speed rises by a minimum-jerk step, cruises and falls in the same
 * way, so that position has continuous derivatives up to the third. */
class CLegProfile
{
   public:
	CLegProfile() = default;
	/** Length [m] >= 0, cruise speed [m/s], peak acceleration [m/s^2]. A leg too short to reach `speed` has
	 * its own lower top speed. */
	CLegProfile(double length, double speed, double acceleration);

	double duration() const { return 2 * m_ramp + m_cruise; }
	/** Distance [m], speed [m/s], acceleration [m/s^2] at t seconds from the leg's start. */
	TProfileValue at(double t) const;

   private:
	double m_length{0}, m_speed{0}, m_ramp{0}, m_cruise{0};
};
}  // namespace posidonia
