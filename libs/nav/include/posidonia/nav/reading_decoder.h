#pragma once

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <posidonia/nav/nav_statistics.h>
#include <posidonia/nav/navigator_setup.h>
#include <posidonia/nav/sensor_reading.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/CObservationPressure.h>

#include <memory>
#include <optional>

namespace posidonia
{
/** From observations to readings. Allocates nothing. */
class CReadingDecoder
{
   public:
	explicit CReadingDecoder(std::shared_ptr<const TNavigatorSetup> setup);

	/** Calls `take(reading)` for each reading in `observation`: none for classes that navigation does not
	 * know and for invalid content (which is counted), two for an IMU that tells its attitude too. Throws
	 * CError for a sensor label without an entry. */
	template <class TAKE>
	void decode(const mrpt::obs::CObservation& observation, TAKE&& take)
	{
		m_count = 0;
		decode(observation);
		for (int i = 0; i < m_count; i++)
			take(m_readings[i]);
	}
	/** What was refused on arrival, by sensor. */
	TSensorCount& count(int sensor) { return m_counts[static_cast<size_t>(sensor)]; }
	const TSensorCount& count(int sensor) const { return m_counts[static_cast<size_t>(sensor)]; }

   private:
	void decode(const mrpt::obs::CObservation& observation);
	void decodeImu(const mrpt::obs::CObservationIMU& imu);
	void decodeDvl(const CObservationDVL& dvl);
	void decodePressure(const CObservationPressure& pressure);
	void decodeGps(const mrpt::obs::CObservationGPS& gps);
	/** Index of the label; CError where `entries` has none. */
	template <class SPEC>
	int entryOf(const mrpt::obs::CObservation& o, const std::map<std::string, SPEC>& entries) const;
	template <class WHAT>
	void push(double stamp, int sensor, const WHAT& what);

	std::shared_ptr<const TNavigatorSetup> m_setup;
	std::vector<TSensorCount> m_counts;
	TSensorReading m_readings[2];
	int m_count{0};
};
}  // namespace posidonia
