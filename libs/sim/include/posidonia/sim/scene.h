#pragma once

#include <posidonia/sim/sea_floor.h>
#include <posidonia/sim/simulation_options.h>

#include <memory>

namespace posidonia
{
/** The moment of a stereo pair. */
struct TExposure
{
	Eigen::Isometry3d T_map_body;
	double water_factor{1};	 ///< On both coefficients of the water: a burst of turbidity
};

/** The world and the stereo rig in it, as they truly are ([CalibrationError] included). Const and
 * thread-safe. */
class CScene
{
   public:
	/** `nominal`: what the rawlog and sensors.ini say. Without a stereo rig in it (or with [Simulation]
	 * stereo = false) there is a floor and no camera. Throws CError when there are two rigs. */
	CScene(const TSimulationOptions& options, const TSensorSuite& nominal);
	~CScene();

	/** What the ranges of the DVL run to. */
	const std::shared_ptr<const CSeaFloor>& floor() const { return m_floor; }
	bool hasCamera() const { return m_camera != nullptr; }
	/** A picture stamped t shows the world of t + cameraClock() [s]: the caller brings the pose of then. */
	double cameraClock() const;
	/** Both eyes; the bytes depend on the arguments only. `frame` gives each pair its own noise. */
	TGreyPair photograph(const TExposure& exposure, uint64_t frame) const;
	TGreyPair photograph(const Eigen::Isometry3d& T_map_body, uint64_t frame) const
	{
		return photograph(TExposure{T_map_body}, frame);
	}
	/** Throws CError unless the floor lies below these positions of the body [m, map] and its texture covers
	 * what the camera sees from them, and [Floor] margin more. */
	void requireFloorUnder(const std::vector<Eigen::Vector3d>& positions) const;

   private:
	struct TCamera;
	TFloorOptions m_floor_options;
	std::shared_ptr<const CSeaFloor> m_floor;
	std::unique_ptr<const TCamera> m_camera;
};

/** The floor of the options. */
std::shared_ptr<const CSeaFloor> makeSeaFloor(const TSimulationOptions& options);
}  // namespace posidonia
