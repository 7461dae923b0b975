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

/** Flags of the format dvl-gt-csv. */
struct TDvlGtFlags
{
	TCLAP::ValueArg<double> noise, bias, bias_time;
	TCLAP::ValueArg<int> seed;

	explicit TDvlGtFlags(TCLAP::CmdLine& cmd)
		: noise(
			  "", "attitude-noise", "dvl-gt-csv: white noise put on roll, pitch and heading (default: 0)",
			  false, 0, "DEG", cmd),
		  bias(
			  "", "attitude-bias",
			  "dvl-gt-csv: slow error put on the attitude, Gauss-Markov about north, east and down (default: "
			  "0)",
			  false, 0, "DEG", cmd),
		  bias_time(
			  "", "attitude-bias-time", "Correlation time of --attitude-bias (default: 600)", false, 600, "S",
			  cmd),
		  seed("", "seed", "Of --attitude-noise and --attitude-bias (default: 1)", false, 1, "N", cmd)
	{
	}

	/** Throws CUsageError for a value out of range, or one that would have no effect. */
	TAttitudeErrors values(bool dvl_gt) const
	{
		check(noise, noise.getValue() >= 0, "must be >= 0 [deg]", dvl_gt, "without --format dvl-gt-csv");
		check(bias, bias.getValue() >= 0, "must be >= 0 [deg]", dvl_gt, "without --format dvl-gt-csv");
		const bool biased = bias.getValue() > 0, any = biased || noise.getValue() > 0;
		check(bias_time, bias_time.getValue() > 0, "must be > 0 [s]", biased, "without --attitude-bias");
		check(seed, seed.getValue() >= 0, "must be >= 0", any, "without --attitude-noise or --attitude-bias");
		constexpr double kDegree = M_PI / 180;
		return {
			noise.getValue() * kDegree, bias.getValue() * kDegree, bias_time.getValue(),
			static_cast<unsigned>(seed.getValue())};
	}

   private:
	static void check(
		const TCLAP::Arg& flag, bool in_range, const std::string& range, bool effect,
		const std::string& unless)
	{
		if (!flag.isSet()) return;
		if (!in_range) throw CUsageError("--" + flag.getName(), range, "give another number");
		if (!effect) throw CUsageError("--" + flag.getName(), "has no effect " + unless, "leave it out");
	}
};

/** Those of the format euroc. */
void refuseEurocFlags(const std::vector<const TCLAP::Arg*>& flags)
{
	for (const auto* flag : flags)
		if (flag->isSet())
			throw CUsageError(
				"--" + flag->getName(), "has no effect with --format dvl-gt-csv", "leave it out");
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
		"--format dvl-gt-csv: a folder with DVL.csv and GT.csv (DVL velocities; post-processed position and "
		"attitude), no pictures.\n"
		"Example: auv-dataset2rawlog -i dive7 -o data/dive7.rawlog",
		"The rawlog to write (here a file, not a folder)", "NAME.rawlog");
	auto& cmd = line.cmd();
	TCLAP::ValueArg<std::string> input(
		"i", "input", "The folder that holds mav0/, or mav0 itself; dvl-gt-csv: DVL.csv and GT.csv", false,
		"", "FOLDER", cmd);
	std::vector<std::string> formats{"euroc", "dvl-gt-csv"};
	TCLAP::ValuesConstraint<std::string> one_of(formats);
	TCLAP::ValueArg<std::string> format(
		"", "format", "What FOLDER holds (default: euroc)", false, "euroc", &one_of, cmd);
	TCLAP::SwitchArg skip(
		"", "skip-bad", "Leave bad rows and pictures out, counted, instead of stopping", cmd);
	TCLAP::SwitchArg level(
		"", "level", "Roll and pitch of the body's axes from imu0's first second, at rest", cmd);
	TCLAP::SwitchArg cubic("", "cubic", "Rectify with cubic instead of linear interpolation", cmd);
	TCLAP::SwitchArg overwrite("", "overwrite", "Replace the files of an earlier import", cmd);
	const TDvlGtFlags dvl_gt(cmd);
	if (!line.parse(argc, argv)) return false;

	CIniFile ini = line.ini();
	TSensorSuite sensors = TSensorSuite::sparus2();
	const TExperiment experiment = TExperiment::load(ini, sensors);
	if (line.wantsConfigDump()) {
		std::cout << ini.dump();
		return false;
	}
	if (!input.isSet()) throw CUsageError("-i/--input", "is missing", "give the folder to convert");
	if (line.outputDir().empty())
		throw CUsageError("-o", "is missing", "give the rawlog to write, NAME.rawlog");
	if (format.getValue() == "dvl-gt-csv") {
		params.format = EDatasetFormat::DVL_GT_CSV;
		refuseEurocFlags({&level, &cubic});
	}
	params.attitude_errors = dvl_gt.values(params.format == EDatasetFormat::DVL_GT_CSV);
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
