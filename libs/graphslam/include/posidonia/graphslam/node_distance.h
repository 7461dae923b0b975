#pragma once

#include <cmath>

namespace posidonia
{
/** When the next node is due: at the stereo pair that lies nearest to `distance` from the last node, not at
 * the first one beyond it. */
class CNodeDistance
{
   public:
	/** Ask at each pair. @param displacement from the last node [m] */
	bool reached(double displacement, double distance)
	{
		const double step = std::abs(displacement - m_last);
		const bool is = displacement >= distance - step / 2;
		m_last = is ? 0 : displacement;
		return is;
	}

   private:
	double m_last{0};  ///< Displacement at the pair before [m]
};
}  // namespace posidonia
