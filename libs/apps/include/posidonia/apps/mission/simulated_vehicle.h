#pragma once

#include <posidonia/sim/faults.h>
#include <posidonia/sim/scene.h>
#include <posidonia/sim/sensor_bank.h>
#include <posidonia/sim/vehicle_dynamics.h>

#include <optional>

namespace posidonia
{
/** The simulated half of the loop: the world, the vehicle in it, its instruments and what fails of them.
 * Times are seconds from the start. */
class CSimulatedVehicle
{
   public:
	/** Throws CError when the options can't be simulated. */
	CSimulatedVehicle(
		const TSimulationOptions& options, const TSensorSuite& nominal,
		const std::vector<TFaultOptions>& faults);

	struct TMeasurement
	{
		mrpt::obs::CObservation::Ptr observation;  ///< Null: none (GPS under water, a dropped reading)
		TVehicleState truth;					   ///< At the observation's stamp
		std::optional<uint64_t> frame;			   ///< A stereo pair's number
	};
	/** When the next measurement falls due. */
	double nextTime() const { return m_bank.nextTime(); }
	/** Moves the vehicle there and measures. */
	TMeasurement measure();
	/** The pictures of a stereo pair, of the last measurement. */
	TGreyPair photograph(const TMeasurement& pair) const;
	/** Depth of what the left picture shows (CScene::depths). */
	cv::Mat1f depths(const TMeasurement& pair) const { return m_scene.depths(poseOfExposure(pair)); }

	/** Of the thrusters starboard, port, heave, -1 .. 1, from now on. */
	void setSetPoints(const Eigen::Vector3d& set_points) { m_dynamics.setSetPoints(set_points); }
	/** The true state at `t`, not before the last measurement. */
	TVehicleState moveTo(double t);

	const CScene& scene() const { return m_scene; }
	const CFaults& faults() const { return m_faults; }

   private:
	Eigen::Isometry3d poseOfExposure(const TMeasurement& pair) const;

	CScene m_scene;
	CSensorBank m_bank;
	CFaults m_faults;
	CVehicleDynamics m_dynamics;
	uint64_t m_frame{0};
};
}  // namespace posidonia
