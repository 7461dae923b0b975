#include <posidonia/apps/CSimApp.h>
#include <posidonia/apps/progress.h>
#include <posidonia/apps/world_files.h>
#include <posidonia/base/files.h>

#include <cstdio>
#include <filesystem>
#include <iostream>

namespace posidonia
{
bool CSimApp::initialize(int argc, const char* const* argv)
{
	CCommandLine line(
		name,
		"Simulates a survey: writes DIR/NAME.rawlog, NAME_Images/, NAME.sensors.ini and NAME.gt.tum.\n"
		"Example: auv-sim -c ini/paper-exp2.ini -o data");
	TCLAP::ValueArg<std::string> output_name(
		"", "name", "Name of the set (default: that of the ini)", false, "", "NAME", line.cmd());
	if (!line.parse(argc, argv)) return false;

	CIniFile ini = line.ini();
	m_sensors = TSensorSuite::sparus2();
	params = TExperiment::load(ini, m_sensors);
	if (line.wantsConfigDump()) {
		std::cout << ini.dump();
		return false;
	}
	findWorldFiles(params.simulation, line);
	m_verbosity = line.verbosity();
	const std::string folder = line.outputDir().empty() ? "data" : line.outputDir();
	m_prefix = folder + "/" + (output_name.isSet() ? output_name.getValue() : line.configName());
	return true;
}

void CSimApp::run()
{
	CSurveySimulator simulator(params.simulation, m_sensors);
	makeFolder(std::filesystem::path(m_prefix).parent_path().string());
	{
		CProgress progress("simulating", m_verbosity == 0);
		m_summary = simulator.run(m_prefix, [&](double fraction) { progress.update(fraction); });
	}
	if (m_verbosity == 0) return;
	std::printf(
		"%s.rawlog: %.0f s, %.1f m, %zu observations, %zu of %zu stereo pairs kept (%.0f MB of pictures)\n",
		m_prefix.c_str(), m_summary.duration, m_summary.path_length, m_summary.observations,
		m_summary.kept_pairs, m_summary.stereo_pairs, static_cast<double>(m_summary.image_bytes) / 1e6);
}
}  // namespace posidonia
