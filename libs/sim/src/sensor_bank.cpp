#include <posidonia/base/error.h>
#include <posidonia/sim/scene.h>
#include <posidonia/sim/sensor_bank.h>

#include <algorithm>

namespace posidonia
{
using mrpt::obs::CObservation;

namespace
{
std::string pictureName(const std::string& label, uint64_t frame, const char* side)
{
	char number[32];
	std::snprintf(number, sizeof number, "_%06llu_", static_cast<unsigned long long>(frame));
	return label + number + side + ".png";
}

/** The rig's clock: what it says about each pair without the pixels. */
class CPairAnnouncer
{
   public:
	CPairAnnouncer(const std::string& label, const TStereoSpec& spec) : m_label(label), m_spec(spec) {}
	CObservation::Ptr measure(const TVehicleState&, double stamp)
	{
		const uint64_t frame = m_frame++;
		return makeStereo(
			m_label, stamp, m_spec, pictureName(m_label, frame, "left"),
			pictureName(m_label, frame, "right"));
	}

   private:
	std::string m_label;
	TStereoSpec m_spec;
	uint64_t m_frame{0};
};
}  // namespace

CSensorBank::CSensorBank(const TSimulationOptions& options, const TSensorSuite& nominal)
	: CSensorBank(options, nominal, makeSeaFloor(options))
{
}

CSensorBank::CSensorBank(
	const TSimulationOptions& o, const TSensorSuite& nominal, const std::shared_ptr<const CSeaFloor>& floor)
	: m_start_time(o.run.start_time)
{
	const uint64_t seed = o.run.seed;
	const auto errors = drawnSigns(o.calibration_error, seed);
	m_models.imu = add<CSimulatedImu>(o.run.imu, nominal.imu, o.imu, seed);
	m_models.ahrs = add<CSimulatedAhrs>(o.run.ahrs, nominal.ahrs, o.ahrs, seed);
	m_models.dvl = add<CSimulatedDvl>(o.run.dvl, nominal.dvl, o.dvl, errors, floor, seed);
	m_models.pressure = add<CSimulatedPressure>(o.run.pressure, nominal.pressure, o.pressure, seed);
	m_models.gps = add<CSimulatedGps>(o.run.gps, nominal.gps, o.gps, o.world, seed);
	add<CPairAnnouncer>(o.run.stereo, nominal.stereo);
	if (m_clocks.empty())
		throw CError(
			"[Simulation]", "every sensor is switched off", "switch on at least one, e.g. imu = true");
}

template <class SENSOR, class SPEC, class... ARGS>
std::map<std::string, std::shared_ptr<const SENSOR>> CSensorBank::add(
	bool enabled, const std::map<std::string, SPEC>& specs, const ARGS&... args)
{
	std::map<std::string, std::shared_ptr<const SENSOR>> models;
	if (!enabled) return models;
	for (const auto& [label, spec] : specs) {
		const auto sensor = std::make_shared<SENSOR>(label, spec, args...);
		models[label] = sensor;
		m_clocks.push_back({spec.rate, 0, [sensor](const TVehicleState& state, double stamp) {
								return sensor->measure(state, stamp);
							}});
	}
	return models;
}

double CSensorBank::stampOfTick(const TClock& clock) const
{
	// Through the stamp's 100 ns ticks, so that the truth belongs to the stamp as it is written.
	return mrpt::Clock::toDouble(stampFrom(m_start_time + static_cast<double>(clock.tick) / clock.rate));
}

size_t CSensorBank::due() const
{
	const auto earlier = [this](const TClock& a, const TClock& b) { return stampOfTick(a) < stampOfTick(b); };
	const auto first = std::min_element(m_clocks.begin(), m_clocks.end(), earlier);	 // the first of equals
	return static_cast<size_t>(first - m_clocks.begin());
}

double CSensorBank::nextTime() const
{
	return stampOfTick(m_clocks[due()]) - m_start_time;
}

CObservation::Ptr CSensorBank::measure(const TVehicleState& state)
{
	TClock& clock = m_clocks[due()];
	const double stamp = stampOfTick(clock);
	clock.tick++;
	return clock.measure(state, stamp);
}
}  // namespace posidonia
