#pragma once

#include <posidonia/obs/observations.h>
#include <posidonia/sim/gauss_markov.h>
#include <posidonia/sim/vehicle_motion.h>

namespace posidonia
{
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

/** Attitude: white noise and a constant heading bias on yaw, pitch and roll; outside of them an error about
 * the map axes that wanders: R_measured = Exp(e) R. */
class CSimulatedAhrs
{
   public:
	CSimulatedAhrs(
		const std::string& label, const TAhrsSpec& spec, const TSimulatedAhrsOptions& options, uint64_t seed);
	mrpt::obs::CObservation::Ptr measure(const TVehicleState& state, double stamp);

	/** The wandering error e, a rotation vector about the map's north, east and down [rad]. */
	const Eigen::Vector3d& error() const { return m_wander.value(); }

   private:
	std::string m_label;
	TAhrsSpec m_spec;
	TSimulatedAhrsOptions m_options;
	CNoise m_noise;
	CGaussMarkov<3> m_wander;
	bool m_started{false};
};
}  // namespace posidonia
