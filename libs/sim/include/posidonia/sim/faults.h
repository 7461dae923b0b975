#pragma once

#include <posidonia/base/options.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace mrpt::obs
{
class CObservation;
}

namespace posidonia
{
class CIniFile;
struct TSensorSuite;

// clang-format off
/** A section [Fault.<name>]: something that goes wrong in a run. Which keys there are depends on `kind`:
 *
 * | kind      | keys                 | what happens                                    |
 * | --------- | -------------------- | ----------------------------------------------- |
 * | drop_out  | label, rate          | this part of the sensor's observations is lost  |
 * | outlier   | label, rate, size    | this part of them has a gross error             |
 * | bias      | label, size          | the sensor's reading jumps by this              |
 * | blackout  |                      | the stereo pictures are black                   |
 * | turbidity | factor               | on the water's attenuation and backscatter      |
 * | current   | velocity             | water's velocity on top of [Current]'s          |
 * | thruster  | thruster, efficiency | it gives only this part of its thrust           | */
// clang-format on
struct TFaultOptions
{
	std::string name;  ///< From the section
	std::string kind;
	double time{0}, duration{0}, spread{0};
	unsigned seed{1};
	std::string label;
	double rate{1};
	std::vector<double> size;
	double factor{1};
	std::vector<double> velocity{0, 0, 0};
	std::string thruster;
	double efficiency{0};

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice(
			"kind", kind, {"drop_out", "outlier", "bias", "blackout", "turbidity", "current", "thruster"},
			"What goes wrong");
		v.number("time", time, atLeast(0), "Start [s from the run's start]");
		v.number("duration", duration, atLeast(0), "[s]; 0: to the end");
		v.number("spread", spread, atLeast(0), "The start comes later by up to this, by the seed [s]");
		v.seed("seed", seed, "With the run's seed: every random number of this fault follows from them");
		const bool drawn = kind == "drop_out" || kind == "outlier";
		const bool shifted = kind == "outlier" || kind == "bias";
		if (drawn || shifted) v.text("label", label, "sensorLabel of the sensor that it befalls");
		if (drawn) v.number("rate", rate, between(0, 1), "Part of the observations that it befalls");
		if (shifted)
			v.numbers(
				"size", size, 0, anyNumber(),
				"outlier: its length; bias: IMU 3 (gyroscope, body axes) [deg/s], AHRS 1 (heading) [deg], "
				"DVL 3 (body axes) [m/s], pressure 1 [Pa], GPS 2 (north east) [m]");
		if (kind == "turbidity") v.number("factor", factor, atLeast(0), "On attenuation and backscatter");
		if (kind == "current") v.numbers("velocity", velocity, 3, between(-5, 5), "North east down [m/s]");
		if (kind == "thruster") {
			v.choice("thruster", thruster, {"starboard", "port", "heave"}, "Which one");
			v.number("efficiency", efficiency, between(0, 1), "Factor on its thrust");
		}
	}
};

/** The faults of an ini, by name; before its refuseUnknown(). Throws CError, with file, section and key, for
 * a fault without a kind and for keys and values as any section's. */
std::vector<TFaultOptions> loadFaults(CIniFile& ini);

/** All faults of a run; times t [s] from its start. Every fault draws from a generator of its own, so that
 * one more or less leaves the others alone. */
class CFaults
{
   public:
	using observation_ptr = std::shared_ptr<mrpt::obs::CObservation>;

	/** `seed`: the run's. Throws CError, with section and key, for a label that `sensors` does not know, a
	 * sensor that can't have this fault, or a `size` of another shape. */
	CFaults(const std::vector<TFaultOptions>& faults, const TSensorSuite& sensors, uint64_t seed);
	~CFaults();
	CFaults(CFaults&&) noexcept;

	/** What the vehicle gets of `observation`, asked once for each in order of time: itself, a changed copy,
	 * or null when it is lost. */
	observation_ptr apply(const observation_ptr& observation, double t);

	bool blackout(double t) const;						 ///< Are the stereo pictures black?
	double turbidity(double t) const;					 ///< Factor on attenuation and backscatter
	Eigen::Vector3d current(double t) const;			 ///< On top of [Current]'s, map axes [m/s]
	Eigen::Vector3d thrusterEfficiency(double t) const;	 ///< Starboard, port, heave: factors on the thrust
	/** Names of the faults that are on. */
	std::vector<std::string> active(double t) const;

   private:
	class CFault;
	template <class F>
	void forActive(const char* kind, double t, F&& f) const;
	std::vector<CFault> m_faults;
};
}  // namespace posidonia
