#pragma once

#include <posidonia/sim/simulation_options.h>

#include <functional>

namespace posidonia
{
/** All sensors of a vehicle with their clocks. Whoever moves the vehicle (a route in closed form, or dynamics
 * in a loop) brings the true state to nextTime() and asks for the measurement:
 *
 *   while (bank.nextTime() <= end) use(bank.measure(vehicle.stateAt(bank.nextTime())));
 */
class CSensorBank
{
   public:
	/** `nominal`: what the rawlog and sensors.ini say; the world differs from it by
	 * options.calibration_error. */
	CSensorBank(const TSimulationOptions& options, const TSensorSuite& nominal);

	/** When the next measurement falls due [s from the start]: exactly its stamp - start_time. */
	double nextTime() const;
	/** The due measurement, null when the sensor has none (GPS under water). A stereo observation carries the
	 * rig and the names of its pictures, LABEL_000012_left.png, but no pixels. Measurements of one instant
	 * come in the order IMU, AHRS, DVL, pressure, GPS, stereo. */
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state);

   private:
	struct TClock
	{
		double rate;  ///< [Hz]
		uint64_t tick{0};
		std::function<mrpt::obs::CObservation::Ptr(const TVehicleState&, double stamp)> measure;
	};
	template <class SPECS, class MAKE>
	void add(bool enabled, const SPECS& specs, MAKE&& make);
	double stampOfTick(const TClock& clock) const;
	size_t due() const;	 ///< Index of the clock that is next

	double m_start_time;
	std::vector<TClock> m_clocks;
};
}  // namespace posidonia
