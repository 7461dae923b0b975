#pragma once

#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/sim/calibration_error.h>
#include <posidonia/sim/random.h>
#include <posidonia/sim/sea_floor.h>
#include <posidonia/sim/vehicle_motion.h>

#include <memory>
#include <optional>

namespace posidonia
{
/** Section [SimulatedDvl]. */
struct TSimulatedDvlOptions
{
	double sigma_altitude{0.01}, min_altitude{0.5}, max_altitude{81}, max_slant_range{81};
	bool random_scale{false};
	double outlier_rate{0}, outlier_speed{1.5}, beam_loss{0};
	double lock_loss_start{0}, lock_loss_duration{0};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("sigma_altitude", sigma_altitude, atLeast(0), "White noise of altitude and ranges [m]");
		v.number("min_altitude", min_altitude, atLeast(0), "No bottom lock below [m] (sparus2.scn: 0.5)");
		v.number("max_altitude", max_altitude, above(0), "No bottom lock above [m] (sparus2.scn: 81)");
		v.number("max_slant_range", max_slant_range, above(0), "A beam that runs farther is lost [m]");
		v.flag("random_scale", random_scale, "Draw an error of the scale with the spec's sigma_scale");
		v.number("outlier_rate", outlier_rate, between(0, 1), "Part of the pings with a gross error");
		v.number("outlier_speed", outlier_speed, atLeast(0), "Length of the gross error [m/s]");
		v.number("beam_loss", beam_loss, between(0, 1), "Part of the beams that return nothing");
		v.number(
			"lock_loss_start", lock_loss_start, atLeast(0), "No bottom lock from here on [s from start]");
		v.number("lock_loss_duration", lock_loss_duration, atLeast(0), "... for so long [s]; 0: never");
	}
};

/** Four beams, each the velocity along it, scale b . v + white noise; the velocity vector is the
 * least-squares solution of the beams that return. Three determine it, and its covariance is then stated in
 * the observation; with all four the covariance stays all zero: that of sensors.ini. */
class CSimulatedDvl
{
   public:
	CSimulatedDvl(
		const std::string& label, const TDvlSpec& nominal, const TSimulatedDvlOptions& options,
		const TCalibrationErrorOptions& errors, std::shared_ptr<const CSeaFloor> floor, uint64_t seed);
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state, double stamp);

	double scale() const { return m_scale; }  ///< Measured / true velocity

   private:
	Eigen::Vector3d trueVelocity(const TVehicleState& state) const;
	double trueAltitude(const TVehicleState& state) const;
	Eigen::Vector4d trueRanges(const TVehicleState& state) const;
	Eigen::Vector3d drawOutlier();
	void measureVelocities(const TVehicleState& state, CObservationDVL& dvl);
	void measureRanges(const TVehicleState& state, CObservationDVL& dvl);
	bool hasLock(double altitude, double time) const;
	void loseBeams(const TVehicleState& state, double time, CObservationDVL& dvl);
	void solveVelocity(CObservationDVL& dvl) const;

	std::string m_label;
	TDvlSpec m_nominal;
	TSimulatedDvlOptions m_options;
	Eigen::Isometry3d m_T_body_dvl;	 ///< True
	double m_scale;
	std::shared_ptr<const CSeaFloor> m_floor;
	Eigen::Matrix<double, 3, 4> m_beams;
	CNoise m_noise, m_outliers, m_losses;
	std::optional<double> m_start;	///< Stamp of the first ping
};
}  // namespace posidonia
