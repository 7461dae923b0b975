#include <posidonia/obs/frames.h>
#include <posidonia/sim/simulated_pressure.h>

#include "make_observation.h"

namespace posidonia
{
using Eigen::Isometry3d;

CTide::CTide(const TSimulatedPressureOptions& options, uint64_t seed)
	: m_amplitude(options.tide_amplitude),
	  m_frequency(2 * M_PI / options.tide_period),
	  // One sea: the same tide for every sensor, whatever its label.
	  m_phase(CNoise(seedOf(seed, "tide")).uniform(0, 2 * M_PI))
{
}

double CTide::since(double t) const
{
	return m_amplitude * (std::sin(m_frequency * t + m_phase) - std::sin(m_phase));
}

CSimulatedPressure::CSimulatedPressure(
	const std::string& label, const TPressureSpec& spec, const TSimulatedPressureOptions& options,
	uint64_t seed)
	: m_label(label),
	  m_spec(spec),
	  m_noise(seedOf(seed, label)),
	  m_offset_noise(seedOf(seed, label + " offset")),
	  m_tide(options, seed),
	  m_walked(spec.sigma_offset * m_offset_noise.normal())
{
}

mrpt::obs::CObservation::Ptr CSimulatedPressure::measure(const TVehicleState& state, double stamp)
{
	advanceOffset(stamp);
	const Isometry3d T_body_sensor = m_spec.T_body_sensor();
	auto pressure = makeObservation<CObservationPressure>(m_label, stamp, T_body_sensor);
	const double depth = (state.T_map_body * T_body_sensor.translation()).z();
	pressure->pressure = m_spec.pressureAt(depth) + m_spec.sigma * m_noise.normal() + offset();
	return pressure;
}

void CSimulatedPressure::advanceOffset(double stamp)
{
	if (m_start) m_walked += m_spec.offset_walk / std::sqrt(m_spec.rate) * m_offset_noise.normal();
	if (!m_start) m_start = stamp;
	m_tide_pressure = m_spec.water_density * kGravity * m_tide.since(stamp - *m_start);
}
}  // namespace posidonia
