#pragma once

#include <sys/wait.h>
#include <temp_folder.h>
#include <tiny_survey.h>

#include <cstdio>
#include <cstdlib>

namespace posidonia::testing
{
/** What a program printed and how it ended. */
struct TOutcome
{
	std::string out, err;
	int status{-1};	 ///< -1: ended by a signal

	std::string all() const { return "status " + std::to_string(status) + "\n" + out + err; }
};

/** Runs POSIDONIA_BIN_DIR/<app>; `arguments` as in a shell. */
inline TOutcome runProgram(const std::string& app, const std::string& arguments)
{
	static const CProgramFolder folder("cli-output");
	const std::string out = folder / "out", err = folder / "err";
	const std::string command = std::string("'") + POSIDONIA_BIN_DIR + "/" + app + "' " + arguments + " >'" +
								out + "' 2>'" + err + "' </dev/null";
	const int raw = std::system(command.c_str());
	return {fileBytes(out), fileBytes(err), WIFEXITED(raw) ? WEXITSTATUS(raw) : -1};
}

/** The tiny survey, made by auv-sim once in a program. */
struct TSurvey
{
	CProgramFolder folder{"cli"};
	std::string ini, prefix, rawlog;
	TOutcome outcome;

	TSurvey() : ini(folder / "tiny.ini"), prefix(folder / "tiny"), rawlog(folder / "tiny.rawlog")
	{
		std::ofstream(ini) << tinySurveyIni();
		outcome = runProgram("auv-sim", "-c " + ini + " -o " + (folder / "."));
	}
};
inline const TSurvey& survey()
{
	static const TSurvey made;
	EXPECT_EQ(made.outcome.status, 0) << made.outcome.all();
	return made;
}

inline const std::vector<std::string>& allApps()
{
	static const std::vector<std::string> apps{
		"auv-sim", "auv-ekf", "auv-graphslam", "auv-eval", "auv-dataset2rawlog", "auv-graph-optimize"};
	return apps;
}

/** Ends with `status`, says each of `parts` on stderr as "app: error: ..." and nothing of an error on stdout.
 */
inline void expectError(
	const std::string& app, const std::string& arguments, int status, const std::vector<std::string>& parts)
{
	const TOutcome o = runProgram(app, arguments);
	EXPECT_EQ(o.status, status) << app << " " << arguments << "\n" << o.all();
	EXPECT_HOLDS(o.err, app + ": error: ");
	for (const auto& part : parts)
		EXPECT_HOLDS(o.err, part) << app << " " << arguments;
	for (const char* noise : {"Call stack", "Location:", "terminate"})
		EXPECT_EQ(o.err.find(noise), std::string::npos) << o.err;
}
}  // namespace posidonia::testing
