#pragma once

#include <posidonia/apps/command_line.h>
#include <posidonia/apps/experiment.h>
#include <posidonia/sim/survey_simulator.h>

#include <optional>

namespace posidonia
{
/** auv-sim: a simulated survey as a rawlog. */
class CSimApp
{
   public:
	static constexpr const char* name = "auv-sim";

	/** False when --help, --version or --dump-config was answered. Throws CError, CUsageError. */
	bool initialize(int argc, const char* const* argv);
	void run();

	/** <folder>/<name> of what run() writes. */
	const std::string& prefix() const { return m_prefix; }
	const TSimulationSummary& results() const { return m_summary; }
	TExperiment params;

   private:
	TSensorSuite m_sensors;
	std::string m_prefix;
	int m_verbosity{1};
	TSimulationSummary m_summary;
};
}  // namespace posidonia
