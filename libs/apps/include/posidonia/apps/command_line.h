#pragma once

#include <posidonia/base/ini_file.h>
#include <tclap/CmdLine.h>

#include <string>
#include <vector>

namespace posidonia
{
/** The flags that every app shares, under the same names. An app adds its own to cmd() before parse(). */
class CCommandLine
{
   public:
	/** `output_text`: what -o names, for --help. `takes_config`: else there is no -c, --set, --dump-config.
	 */
	CCommandLine(
		const std::string& app, const std::string& description,
		const std::string& output_text = "Folder for the results", const std::string& output_type = "DIR",
		bool takes_config = true);

	TCLAP::CmdLine& cmd() { return m_cmd; }

	/** False when --help or --version was asked for and answered. Throws CUsageError. */
	bool parse(int argc, const char* const* argv);

	/** The ini of -c (without it `fallback` where given and existing, else empty: all defaults) with every
	 * --set. */
	CIniFile ini(const std::string& fallback = "") const;
	std::string configName() const;	 ///< "paper-exp1" of "ini/paper-exp1.ini"; "defaults" without -c
	/** A file that the ini names: as it stands, or relative to the ini's folder. */
	std::string besideConfig(const std::string& path) const;
	std::string outputDir() const { return m_output.getValue(); }
	int verbosity() const { return m_verbosity.getValue(); }
	bool wantsConfigDump() const { return m_dump.getValue(); }
	const std::string& app() const { return m_app; }

   private:
	std::string m_app;
	TCLAP::CmdLine m_cmd;
	TCLAP::ValueArg<std::string> m_config;
	TCLAP::ValueArg<std::string> m_output;
	TCLAP::MultiArg<std::string> m_set;
	TCLAP::ValueArg<int> m_verbosity;
	TCLAP::SwitchArg m_dump;
};

/** "Posidonia 0.1.0 ...", with the licences of what is linked. */
std::string versionText();

/** main() of an app class with initialize(argc, argv) -> bool and run(): prints "app: error: ..." and returns
 * the exit status: 0 done (or the app's own exitStatus(), when it has one), 1 failed, 2 wrong command line.
 */
template <class APP>
int runApp(int argc, const char* const* argv);

/** Prints the problem; returns the exit status. */
int reportProblem(const char* app, const std::exception& problem);

/** What an app ends with after run(): 0, unless it has an exitStatus(). */
template <class APP>
auto statusAfterRun(const APP& app, int) -> decltype(app.exitStatus())
{
	return app.exitStatus();
}
template <class APP>
int statusAfterRun(const APP&, long)
{
	return 0;
}
}  // namespace posidonia

template <class APP>
int posidonia::runApp(int argc, const char* const* argv)
{
	try {
		APP app;
		if (!app.initialize(argc, argv)) return 0;
		app.run();
		return statusAfterRun(app, 0);
	}
	catch (const std::exception& problem) {
		return reportProblem(APP::name, problem);
	}
}
