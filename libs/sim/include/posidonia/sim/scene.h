#pragma once

#include <posidonia/sim/sea_floor.h>
#include <posidonia/sim/simulation_options.h>

#include <memory>

namespace posidonia
{
/** A stereo pair's exposure. */
struct TExposure
{
	Eigen::Isometry3d T_map_body;		  ///< In the middle of it
	Eigen::Vector3d v_body{0, 0, 0};	  ///< Velocity in body axes [m/s], for motion blur
	Eigen::Vector3d omega_body{0, 0, 0};  ///< Angular rate in body axes [rad/s], for motion blur
	double water_factor{1};				  ///< On both coefficients of the water: a burst of turbidity
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
	/** Depth along the left camera's axis of what each of its pixels shows [m]; infinite where there is no
	 * floor. */
	cv::Mat1f depths(const Eigen::Isometry3d& T_map_body) const;
	/** PNG of the world from above, north up, with a way [m, map] in it (may be empty). */
	void writeOverview(const std::string& path, const std::vector<Eigen::Vector3d>& way) const;
	/** Throws CError unless the floor lies below these positions of the body [m, map] and its texture covers
	 * what the camera sees from them, and [Floor] margin more. */
	void requireFloorUnder(const std::vector<Eigen::Vector3d>& positions) const;

   private:
	struct TCamera;
	std::vector<CFloorRenderer::TMoment> momentsOf(const TExposure& exposure, double aside) const;
	TFloorOptions m_floor_options;
	std::shared_ptr<const CSeaFloor> m_floor;
	std::unique_ptr<const TCamera> m_camera;
};

/** The floor of the options. */
std::shared_ptr<const CSeaFloor> makeSeaFloor(const TSimulationOptions& options);
}  // namespace posidonia
