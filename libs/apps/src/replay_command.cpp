#include <posidonia/apps/replay_command.h>
#include <posidonia/apps/run_texts.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>

#include <filesystem>
#include <iostream>

namespace posidonia
{
std::string TReplayInput::name() const
{
	return std::filesystem::path(rawlog).stem().string();
}

CReplayCommand::CReplayCommand(CCommandLine& line)
	: m_line(line),
	  m_rawlog("r", "rawlog", "Rawlog to replay", false, "", "FILE.rawlog", line.cmd()),
	  m_truth(
		  "g", "ground-truth", "True trajectory, TUM (only for scoring)", false, "", "FILE.tum", line.cmd()),
	  m_assume("", "assume-defaults", "Without NAME.sensors.ini, take the sensors of SPARUS II", line.cmd())
{
}

void CReplayCommand::requireRawlog() const
{
	if (m_rawlog.isSet()) return requireFile(m_rawlog.getValue(), "give an existing rawlog with -r/--rawlog");
	if (!m_line.wantsConfigDump())
		throw CUsageError("-r/--rawlog", "is missing", "give the rawlog to replay");
}

bool CReplayCommand::load(CIniFile ini, TReplayInput& input, TExperiment& experiment)
{
	requireRawlog();
	input.rawlog = m_rawlog.getValue();
	input.log_sensors =
		m_rawlog.isSet() ? sensorsOfRawlog(input.rawlog, m_assume.getValue()) : TSensorSuite::sparus2();
	input.sensors = input.log_sensors;
	experiment = TExperiment::load(ini, input.sensors);
	input.config = ini.dump();
	input.verbosity = m_line.verbosity();
	if (m_line.wantsConfigDump()) {
		std::cout << input.config;
		return false;
	}
	input.truth = truthFor(input.rawlog, m_truth.getValue());
	return true;
}
}  // namespace posidonia
