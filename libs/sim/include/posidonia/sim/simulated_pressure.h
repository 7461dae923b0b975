#pragma once

#include <posidonia/obs/CObservationPressure.h>
#include <posidonia/obs/sensor_suite.h>
#include <posidonia/sim/random.h>
#include <posidonia/sim/vehicle_motion.h>

#include <optional>

namespace posidonia
{
/** Section [SimulatedPressure]. */
struct TSimulatedPressureOptions
{
	double tide_amplitude{0}, tide_period{44714};
	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number("tide_amplitude", tide_amplitude, atLeast(0), "Half of high less low water [m]; 0: no tide");
		v.number("tide_period", tide_period, above(0), "[s] (M2, the moon's half day: 12.42 h)");
	}
};

/** The height of the sea's surface h(t) = A sin(2 pi t / T + phase), its phase by the seed, as the change
 * since the start; high water counts positive. */
class CTide
{
   public:
	CTide(const TSimulatedPressureOptions& options, uint64_t seed);
	/** h(t) - h(0) [m], t [s] from the start. */
	double since(double t) const;

   private:
	double m_amplitude, m_frequency, m_phase;
};

/** Absolute pressure: that of the sensor's depth below the map's origin + offset + white noise. The offset
 * has a value at the start, walks and follows the tide: high water stands higher over the sensor. */
class CSimulatedPressure
{
   public:
	CSimulatedPressure(
		const std::string& label, const TPressureSpec& spec, const TSimulatedPressureOptions& options,
		uint64_t seed);
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state, double stamp);

	/** All of the error but the white noise: start + walk + tide [Pa]. */
	double offset() const { return m_walked + m_tide_pressure; }

   private:
	void advanceOffset(double stamp);

	std::string m_label;
	TPressureSpec m_spec;
	CNoise m_noise, m_offset_noise;
	CTide m_tide;
	double m_walked, m_tide_pressure{0};  ///< [Pa]
	std::optional<double> m_start;		  ///< Stamp of the first reading
};
}  // namespace posidonia
