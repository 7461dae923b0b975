#include <posidonia/control/depth_guidance.h>

#include <algorithm>

namespace posidonia
{
namespace
{
constexpr double kSupposedAltitude = 0.5;  // COLA2: an altitude lost for good is taken as this [m]
}

double CDepthGuidance::altitude(const TControlState& navigation)
{
	if (navigation.altitude) {
		m_stamp = navigation.stamp;
		m_altitude = *navigation.altitude;
		m_depth = navigation.depth();
		return m_altitude;
	}
	if (navigation.stamp - m_stamp > m_options.lost_altitude) return kSupposedAltitude;
	return m_altitude - (navigation.depth() - m_depth);
}

double CDepthGuidance::target(const TStep& step, const TControlState& navigation)
{
	if (!step.altitude_mode) return step.depth;
	return std::max(0.0, navigation.depth() + altitude(navigation) - step.altitude);
}
}  // namespace posidonia
