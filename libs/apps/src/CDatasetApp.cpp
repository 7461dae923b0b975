#include <posidonia/apps/CDatasetApp.h>
#include <posidonia/apps/experiment.h>
#include <posidonia/apps/progress.h>
#include <posidonia/base/files.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

namespace posidonia
{
namespace
{
/** The datum, where the ini has a section [World]. */
std::optional<TWorldOptions> datumOf(const CIniFile& ini, const TExperiment& experiment)
{
	const auto sections = ini.sections();
	const bool given = std::find(sections.begin(), sections.end(), "World") != sections.end();
	return given ? std::optional(experiment.simulation.world) : std::nullopt;
}
}  // namespace

bool CDatasetApp::initialize(int argc, const char* const* argv)
{
	CCommandLine line(
		name,
		"Converts a folder in EuRoC's layout, with an AUV's sensors, to NAME.rawlog, NAME_Images/ (rectified "
		"pairs),\n"
		"NAME.sensors.ini and NAME.gt.tum. Of the ini only [World] is used: the datum where body.yaml has "
		"none.\n"
		"Example: auv-dataset2rawlog -i dive7 -o data/dive7.rawlog",
		"The rawlog to write (here a file, not a folder)", "NAME.rawlog");
	auto& cmd = line.cmd();
	TCLAP::ValueArg<std::string> input(
		"i", "input", "The folder that holds mav0/, or mav0 itself", false, "", "FOLDER", cmd);
	TCLAP::SwitchArg skip(
		"", "skip-bad", "Leave bad rows and pictures out, counted, instead of stopping", cmd);
	TCLAP::SwitchArg level(
		"", "level", "Roll and pitch of the body's axes from imu0's first second, at rest", cmd);
	TCLAP::SwitchArg cubic("", "cubic", "Rectify with cubic instead of linear interpolation", cmd);
	TCLAP::SwitchArg overwrite("", "overwrite", "Replace the files of an earlier import", cmd);
	if (!line.parse(argc, argv)) return false;

	CIniFile ini = line.ini();
	TSensorSuite sensors = TSensorSuite::sparus2();
	const TExperiment experiment = TExperiment::load(ini, sensors);
	if (line.wantsConfigDump()) {
		std::cout << ini.dump();
		return false;
	}
	if (!input.isSet()) throw CUsageError("-i/--input", "is missing", "give the folder that holds mav0/");
	if (line.outputDir().empty())
		throw CUsageError("-o", "is missing", "give the rawlog to write, NAME.rawlog");
	params.input = input.getValue();
	params.output = line.outputDir();
	params.skip_bad = skip.getValue();
	params.level = level.getValue();
	params.cubic = cubic.getValue();
	params.overwrite = overwrite.getValue();
	params.datum = datumOf(ini, experiment);
	m_verbosity = line.verbosity();
	return true;
}

void CDatasetApp::run()
{
	const auto folder = std::filesystem::path(params.output).parent_path();
	if (!folder.empty()) makeFolder(folder.string());
	{
		std::string stage;
		std::optional<CProgress> progress;
		m_report = importDataset(params, [&](const std::string& now, double fraction) {
			if (now != stage) progress.emplace(stage = now, m_verbosity == 0);
			progress->update(fraction);
		});
	}
	if (m_verbosity > 0) std::cout << params.output << ":\n" << m_report.text();
}
}  // namespace posidonia
