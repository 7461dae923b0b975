#pragma once

#include <posidonia/apps/command_line.h>
#include <posidonia/apps/experiment.h>

#include <string>

namespace posidonia
{
/** What an app that replays a rawlog works on. */
struct TReplayInput
{
	std::string rawlog;
	std::string truth;		   ///< Trajectory to score by; empty: none
	TSensorSuite log_sensors;  ///< As they stand beside the rawlog
	TSensorSuite sensors;	   ///< With the ini's changes
	std::string config;		   ///< The whole configuration as used, as an ini
	int verbosity{1};

	/** "survey" of "data/survey.rawlog". */
	std::string name() const;
};

/** The arguments that such apps share (-r, -g, --assume-defaults), and what follows from them. */
class CReplayCommand
{
   public:
	/** Adds its arguments to `line`, which must live longer. */
	explicit CReplayCommand(CCommandLine& line);

	/** After line.parse(): loads sensors and experiment. False when --dump-config was answered.
	 * Throws CError, CUsageError. */
	bool load(CIniFile ini, TReplayInput& input, TExperiment& experiment);

   private:
	void requireRawlog() const;

	CCommandLine& m_line;
	TCLAP::ValueArg<std::string> m_rawlog, m_truth;
	TCLAP::SwitchArg m_assume;
};
}  // namespace posidonia
