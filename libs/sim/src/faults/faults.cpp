#include <posidonia/base/error.h>
#include <posidonia/base/ini_file.h>
#include <posidonia/obs/sensor_suite.h>
#include <posidonia/sim/faults.h>
#include <posidonia/sim/random.h>

#include <algorithm>

#include "sensor_error.h"

namespace posidonia
{
using Eigen::Vector3d;
using mrpt::obs::CObservation;

std::vector<TFaultOptions> loadFaults(CIniFile& ini)
{
	const std::string prefix = "Fault.";
	std::vector<std::string> sections = ini.sections();
	std::sort(sections.begin(), sections.end());
	std::vector<TFaultOptions> faults;
	for (const auto& section : sections) {
		if (section.compare(0, prefix.size(), prefix) != 0) continue;
		auto fault = ini.load<TFaultOptions>(section);
		if (fault.kind.empty())
			throw CError(
				ini.name(), "[" + section + "] has no key 'kind'", "add kind = drop_out, current ...");
		fault.name = section.substr(prefix.size());
		faults.push_back(fault);
	}
	return faults;
}

/** One fault with its generator. */
class CFaults::CFault
{
   public:
	CFault(const TFaultOptions& options, const TSensorSuite& sensors, uint64_t seed);
	const TFaultOptions& options() const { return m_options; }
	bool isOn(double t) const;
	bool befalls(const CObservation& o) const { return m_of_sensor && o.sensorLabel == m_options.label; }
	/** What is left of `so_far`, null if it is lost already: the numbers are drawn all the same, so that the
	 * faults of one sensor leave each other alone. */
	CObservation::Ptr apply(const CObservation::Ptr& so_far);

   private:
	std::string where() const { return "[Fault." + m_options.name + "]"; }
	void checkSize() const;
	Vector3d drawOutlier();

	TFaultOptions m_options;
	CNoise m_noise;
	double m_start;
	bool m_of_sensor;
	TSensorError m_error;
};

namespace
{
uint64_t ownSeed(const TFaultOptions& o, uint64_t seed)
{
	return seedOf(mixed(seed, o.seed), o.name + " " + o.label);
}
bool isOfSensor(const std::string& kind)
{
	return kind == "drop_out" || kind == "outlier" || kind == "bias";
}
}  // namespace

CFaults::CFault::CFault(const TFaultOptions& o, const TSensorSuite& sensors, uint64_t seed)
	: m_options(o),
	  m_noise(ownSeed(o, seed)),
	  m_start(o.time + o.spread * unitInterval(mixed(ownSeed(o, seed)))),
	  m_of_sensor(isOfSensor(o.kind))
{
	if (m_of_sensor) m_error = sensorErrorOf(sensors, o.label, where());
	if (m_of_sensor && o.kind != "drop_out") checkSize();
	if (o.kind == "thruster" && o.thruster.empty())
		throw CError(where() + " thruster", "is missing", "say starboard, port or heave");
}

void CFaults::CFault::checkSize() const
{
	if (m_error.dimension == 0)
		throw CError(
			where() + " label = " + m_options.label, "kind " + m_options.kind + " is not for this sensor",
			"choose drop_out or blackout");
	const int wanted = m_options.kind == "bias" ? m_error.dimension : 1;
	if (static_cast<int>(m_options.size.size()) != wanted)
		throw CError(
			where() + " size", "must be " + std::to_string(wanted) + " number(s) for " + m_options.label, "");
}

bool CFaults::CFault::isOn(double t) const
{
	return t >= m_start && (m_options.duration == 0 || t < m_start + m_options.duration);
}

Vector3d CFaults::CFault::drawOutlier()
{
	Vector3d direction = m_noise.normals<3>();
	direction.tail(3 - m_error.dimension).setZero();
	return m_options.size[0] * direction.normalized();
}

CObservation::Ptr CFaults::CFault::apply(const CObservation::Ptr& so_far)
{
	if (m_options.kind == "bias") {
		Vector3d error(0, 0, 0);
		std::copy(m_options.size.begin(), m_options.size.end(), error.data());
		return so_far ? m_error.add(*so_far, error) : so_far;
	}
	const bool hit = m_noise.uniform(0, 1) < m_options.rate;
	if (m_options.kind == "drop_out") return hit ? nullptr : so_far;
	const Vector3d error = drawOutlier();
	return so_far && hit ? m_error.add(*so_far, error) : so_far;
}

CFaults::CFaults(const std::vector<TFaultOptions>& faults, const TSensorSuite& sensors, uint64_t seed)
{
	for (const auto& fault : faults)
		m_faults.emplace_back(fault, sensors, seed);
}
CFaults::~CFaults() = default;
CFaults::CFaults(CFaults&&) noexcept = default;

CFaults::observation_ptr CFaults::apply(const observation_ptr& observation, double t)
{
	observation_ptr left = observation;
	for (CFault& fault : m_faults)
		if (fault.befalls(*observation) && fault.isOn(t)) left = fault.apply(left);
	return left;
}

template <class F>
void CFaults::forActive(const char* kind, double t, F&& f) const
{
	for (const CFault& fault : m_faults)
		if (fault.options().kind == kind && fault.isOn(t)) f(fault.options());
}

bool CFaults::blackout(double t) const
{
	bool black = false;
	forActive("blackout", t, [&](const TFaultOptions&) { black = true; });
	return black;
}

double CFaults::turbidity(double t) const
{
	double factor = 1;
	forActive("turbidity", t, [&](const TFaultOptions& o) { factor *= o.factor; });
	return factor;
}

Vector3d CFaults::current(double t) const
{
	Vector3d sum(0, 0, 0);
	forActive("current", t, [&](const TFaultOptions& o) { sum += Vector3d(o.velocity.data()); });
	return sum;
}

Vector3d CFaults::thrusterEfficiency(double t) const
{
	Vector3d factors(1, 1, 1);
	forActive("thruster", t, [&](const TFaultOptions& o) {
		factors[o.thruster == "starboard" ? 0 : o.thruster == "port" ? 1 : 2] *= o.efficiency;
	});
	return factors;
}

std::vector<std::string> CFaults::active(double t) const
{
	std::vector<std::string> names;
	for (const CFault& fault : m_faults)
		if (fault.isOn(t)) names.push_back(fault.options().name);
	return names;
}
}  // namespace posidonia
