#pragma once

#include <posidonia/sim/simulation_options.h>

#include <functional>
#include <memory>

namespace posidonia
{
/** The simulated instruments by sensorLabel, for the truth of the errors that they drew. */
struct TSensorModels
{
	std::map<std::string, std::shared_ptr<const CSimulatedImu>> imu;
	std::map<std::string, std::shared_ptr<const CSimulatedAhrs>> ahrs;
	std::map<std::string, std::shared_ptr<const CSimulatedDvl>> dvl;
	std::map<std::string, std::shared_ptr<const CSimulatedPressure>> pressure;
	std::map<std::string, std::shared_ptr<const CSimulatedGps>> gps;
};

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
	/** As above, over a given floor: that of the scene, so that it is made once. */
	CSensorBank(
		const TSimulationOptions& options, const TSensorSuite& nominal,
		const std::shared_ptr<const CSeaFloor>& floor);

	/** When the next measurement falls due [s from the start]: exactly its stamp - start_time. */
	double nextTime() const;
	/** The due measurement, null when the sensor has none (GPS under water). A stereo observation carries the
	 * rig and the names of its pictures, LABEL_000012_left.png, but no pixels. Measurements of one instant
	 * come in the order IMU, AHRS, DVL, pressure, GPS, stereo. */
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state);
	/** Those that are switched on, e.g. models().dvl.at("DVL")->scale(). */
	const TSensorModels& models() const { return m_models; }

   private:
	struct TClock
	{
		double rate;  ///< [Hz]
		uint64_t tick{0};
		std::function<mrpt::obs::CObservation::Ptr(const TVehicleState&, double stamp)> measure;
	};
	/** Makes a sensor of each spec with its clock; returns them by label. */
	template <class SENSOR, class SPEC, class... ARGS>
	std::map<std::string, std::shared_ptr<const SENSOR>> add(
		bool enabled, const std::map<std::string, SPEC>& specs, const ARGS&... args);
	double stampOfTick(const TClock& clock) const;
	size_t due() const;	 ///< Index of the clock that is next

	double m_start_time;
	std::vector<TClock> m_clocks;
	TSensorModels m_models;
};
}  // namespace posidonia
