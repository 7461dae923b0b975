#pragma once

#include <posidonia/apps/CGraphSlamApp.h>
#include <posidonia/apps/CSimApp.h>
#include <posidonia/base/error.h>
#include <posidonia/eval/trajectory_io.h>
#include <temp_folder.h>
#include <tiny_survey.h>

namespace posidonia::testing
{
/** Runs an app class as its main() does; quiet. */
template <class APP>
void runApp(APP& app, std::vector<std::string> args)
{
	args.insert(args.begin(), APP::name);
	args.insert(args.end(), {"-v", "0"});
	std::vector<const char*> argv;
	for (const auto& a : args)
		argv.push_back(a.c_str());
	ASSERT_TRUE(app.initialize(static_cast<int>(argv.size()), argv.data()));
	app.run();
}

/** The tiny survey, simulated once in a program. */
struct TSurvey
{
	CProgramFolder folder{"apps"};
	std::string ini, prefix, rawlog, truth;
	TSimulationSummary summary;

	TSurvey()
	{
		ini = folder / "tiny.ini";
		std::ofstream(ini) << tinySurveyIni();
		CSimApp app;
		runApp(app, {"-c", ini, "-o", folder / "data"});
		prefix = app.prefix();
		rawlog = prefix + ".rawlog";
		truth = prefix + ".gt.tum";
		summary = app.results();
	}
};
inline const TSurvey& survey()
{
	static const TSurvey made;
	return made;
}

/** Graph-SLAM over the tiny survey with two threads, run once in a program. */
inline const CGraphSlamApp& slamRun()
{
	static CGraphSlamApp app;
	static const bool done = [] {
		runApp(
			app, {"-c", survey().ini, "-r", survey().rawlog, "-o", survey().folder / "run", "--set",
				  "Slam.threads=2"});
		return true;
	}();
	EXPECT_TRUE(done);
	return app;
}

/** The poses of a TUM file are those of a trajectory, to the file's digits. */
inline void expectSameTrajectory(const std::string& tum, const TTrajectory& expected)
{
	const TTrajectory read = readTum(tum);
	ASSERT_EQ(read.size(), expected.size()) << tum;
	for (size_t i = 0; i < read.size(); i++) {
		EXPECT_NEAR(read[i].stamp, expected[i].stamp, 1e-6) << tum << " pose " << i;
		EXPECT_LT((read[i].T.matrix() - expected[i].T.matrix()).norm(), 1e-8) << tum << " pose " << i;
	}
}
}  // namespace posidonia::testing
