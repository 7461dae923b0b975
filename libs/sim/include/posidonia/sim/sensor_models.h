#pragma once

#include <mrpt/obs/CObservationGPS.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/CObservationPressure.h>
#include <posidonia/obs/geodesy.h>
#include <posidonia/obs/observations.h>
#include <posidonia/sim/calibration_error.h>
#include <posidonia/sim/random.h>
#include <posidonia/sim/vehicle_motion.h>

/** One class a sensor: the law of the instrument, its noise and nothing else. `measure` is called once for
 * each instant in order of time (random walks advance by 1/rate) with the true state; `stamp` is UTC [s]. */
namespace posidonia
{
/** Section [SimulatedImu]. */
struct TSimulatedImuOptions
{
	double gyro_bias{1e-3}, accel_bias{0.02};
	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("gyro_bias", gyro_bias, atLeast(0), "Sigma of the turn-on bias, each axis [rad/s]");
		v.number("accel_bias", accel_bias, atLeast(0), "Sigma of the turn-on bias, each axis [m/s^2]");
	}
};

/** Section [SimulatedAhrs]. */
struct TSimulatedAhrsOptions
{
	double heading_bias{0};
	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.degrees("heading_bias", heading_bias, between(-180, 180), "Constant error of the heading [deg]");
	}
};

/** Section [SimulatedDvl]. */
struct TSimulatedDvlOptions
{
	double sigma_altitude{0.01}, min_altitude{0.5}, max_altitude{81};
	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("sigma_altitude", sigma_altitude, atLeast(0), "White noise of altitude and ranges [m]");
		v.number("min_altitude", min_altitude, atLeast(0), "No bottom lock below [m] (sparus2.scn: 0.5)");
		v.number("max_altitude", max_altitude, above(0), "No bottom lock above [m] (sparus2.scn: 81)");
	}
};

/** Section [SimulatedGps]. */
struct TSimulatedGpsOptions
{
	double max_depth{1.0}, hdop{1.0};
	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"max_depth", max_depth, anyNumber(),
			"Fixes only while the body is above this depth [m] (COLA2: 1)");
		v.number("hdop", hdop, above(0), "HDOP that the receiver states");
	}
};

class CSimulatedImu
{
   public:
	CSimulatedImu(
		const std::string& label, const TImuSpec& spec, const TSimulatedImuOptions& options, uint64_t seed);
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state, double stamp);

   private:
	std::string m_label;
	TImuSpec m_spec;
	CNoise m_noise;
	Eigen::Vector3d m_gyro_bias, m_accel_bias;
};

/** True angular rate and specific force in the axes of a sensor at T_body_sensor. */
TImuReading trueImuReading(const TVehicleState& state, const Eigen::Isometry3d& T_body_sensor);

class CSimulatedAhrs
{
   public:
	CSimulatedAhrs(
		const std::string& label, const TAhrsSpec& spec, const TSimulatedAhrsOptions& options, uint64_t seed);
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state, double stamp);

   private:
	std::string m_label;
	TAhrsSpec m_spec;
	TSimulatedAhrsOptions m_options;
	CNoise m_noise;
};

class CSimulatedDvl
{
   public:
	CSimulatedDvl(
		const std::string& label, const TDvlSpec& nominal, const TSimulatedDvlOptions& options,
		const TCalibrationErrorOptions& errors, double floor_depth, uint64_t seed);
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state, double stamp);

   private:
	void measureVelocity(const TVehicleState& state, CObservationDVL& dvl);
	void measureRanges(const TVehicleState& state, double true_altitude, CObservationDVL& dvl);

	std::string m_label;
	TDvlSpec m_nominal;
	TSimulatedDvlOptions m_options;
	Eigen::Isometry3d m_T_body_dvl;	 ///< True
	double m_scale, m_floor_depth;
	Eigen::Matrix<double, 3, 4> m_beams;
	CNoise m_noise;
};

class CSimulatedPressure
{
   public:
	CSimulatedPressure(const std::string& label, const TPressureSpec& spec, uint64_t seed);
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state, double stamp);

   private:
	std::string m_label;
	TPressureSpec m_spec;
	CNoise m_noise;
};

class CSimulatedGps
{
   public:
	CSimulatedGps(
		const std::string& label, const TGpsSpec& spec, const TSimulatedGpsOptions& options,
		const TWorldOptions& datum, uint64_t seed);
	/** Null while the body is deeper than max_depth. */
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state, double stamp);

   private:
	std::string m_label;
	TGpsSpec m_spec;
	TSimulatedGpsOptions m_options;
	TWorldOptions m_datum;
	CNoise m_noise;
};
}  // namespace posidonia
