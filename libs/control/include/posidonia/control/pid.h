#pragma once

namespace posidonia
{
struct TPidGains
{
	double gain{0};				///< kp
	double integral_time{1};	///< ti [s]
	double derivative_time{0};	///< td [s]
	double integral_limit{0};	///< Of the integral's output
};

/** kp (e - td dfb/dt) + clamp((kp / ti) int e): the derivative is on the feedback, so that a step of the
 * set-point gives no kick. The integral stands while the output is saturated and the error pushes further. A
 * gap of more than 0.2 s resets (COLA2). */
class CPid
{
   public:
	explicit CPid(const TPidGains& gains) : m_gains(gains) {}

	/** `dt` since the last call [s]. */
	double update(double set_point, double feedback, double dt);
	/** Output given minus output wanted at the last call: 0 when it was not saturated. */
	void noteSaturation(double given_minus_wanted) { m_saturation = given_minus_wanted; }
	void reset();
	double integral() const { return m_integral; }

   private:
	TPidGains m_gains;
	double m_integral{0}, m_feedback{0}, m_saturation{0};
	bool m_started{false};
};
}  // namespace posidonia
