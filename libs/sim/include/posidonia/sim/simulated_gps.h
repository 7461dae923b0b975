#pragma once

#include <mrpt/obs/CObservationGPS.h>
#include <posidonia/obs/geodesy.h>
#include <posidonia/obs/sensor_suite.h>
#include <posidonia/sim/gauss_markov.h>
#include <posidonia/sim/vehicle_motion.h>

namespace posidonia
{
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

/** Fixes of the antenna: white noise and a part that wanders, north and east. Both go on under water, so that
 * a fix does not depend on when the vehicle dived. */
class CSimulatedGps
{
   public:
	CSimulatedGps(
		const std::string& label, const TGpsSpec& spec, const TSimulatedGpsOptions& options,
		const TWorldOptions& datum, uint64_t seed);
	/** Null while the body is deeper than max_depth. */
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state, double stamp);

	const Eigen::Vector2d& bias() const { return m_wander.value(); }  ///< North, east [m]

   private:
	mrpt::obs::gnss::Message_NMEA_GGA makeGga(const TGeodetic& fix, double stamp) const;

	std::string m_label;
	TGpsSpec m_spec;
	TSimulatedGpsOptions m_options;
	TWorldOptions m_datum;
	CNoise m_noise;
	CGaussMarkov<2> m_wander;
	bool m_started{false};
};
}  // namespace posidonia
