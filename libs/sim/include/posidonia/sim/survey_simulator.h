#pragma once

#include <posidonia/geometry/trajectory.h>
#include <posidonia/sim/scene.h>
#include <posidonia/sim/sensor_bank.h>

#include <optional>

namespace posidonia
{
/** A measurement on its way to whoever listens. */
struct TSimulatedObservation
{
	mrpt::obs::CObservation::Ptr observation;
	TVehicleState truth;  ///< At the observation's stamp
	/** A stereo pair's number; empty for any other observation. */
	std::optional<uint64_t> frame;
	/** Is this pair among those that save_images keeps? True for any other observation. */
	bool kept{true};
};

/** What a run has made. */
struct TSimulationSummary
{
	double duration{0}, path_length{0};	 ///< [s], [m] (of the true motion at the stereo stamps)
	size_t observations{0}, stereo_pairs{0}, kept_pairs{0};
	uint64_t image_bytes{0};
};

/** The open-loop simulator: a vehicle follows a route, its sensors are written to a rawlog. */
class CSurveySimulator
{
   public:
	/** Throws CError when the options can't be simulated (route off the floor's texture, no such picture
	 * ...). */
	CSurveySimulator(const TSimulationOptions& options, const TSensorSuite& nominal);

	using progress_t = std::function<void(double fraction)>;
	/** Writes <prefix>.rawlog, <prefix>_Images/, <prefix>.sensors.ini and <prefix>.gt.tum; on
	 * request also depths and <prefix>.overview.png. `progress` may be
	 * empty; it is called from rendering threads, one at a time. */
	TSimulationSummary run(const std::string& prefix, const progress_t& progress = {});

	/** Every observation in order of its stamp, kept or not; starts anew at each call. */
	void stream(const std::function<void(const TSimulatedObservation&)>& consume) const;
	/** The pictures of a streamed stereo pair. Thread-safe. */
	TGreyPair render(const TSimulatedObservation& pair) const;
	/** True depths along the left camera's axis [m] (CScene::depths()). Thread-safe. */
	cv::Mat1f depths(const TSimulatedObservation& pair) const;
	/** As render(), put into the observation itself (no external files). */
	void embedPictures(const TSimulatedObservation& pair) const;

	const CVehicleMotion& motion() const { return m_motion; }
	const CScene& scene() const { return m_scene; }
	double duration() const;  ///< [s]

   private:
	void requireFloorUnderRoute() const;
	TVehicleState exposureOf(const TSimulatedObservation& pair) const;
	void writeOverview(const std::string& path, const TTrajectory& truth) const;

	TSimulationOptions m_options;
	TSensorSuite m_nominal;
	CVehicleMotion m_motion;
	CScene m_scene;
};

/** Writes a trajectory as TUM lines `t x y z qx qy qz qw`, 9 decimals of time and 12 of the rest; whole or
 * not at all. */
void writeTumTrajectory(const std::string& path, const TTrajectory& trajectory);
}  // namespace posidonia
