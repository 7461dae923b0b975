#pragma once

#include <posidonia/apps/CMissionApp.h>

#include "apps_testing.h"

namespace posidonia::testing
{
/** A U of 2 m legs at 3.5 m, and some seconds on station. */
inline const char* const kTinyMission = R"([Mission]
speed = 0.4
timeout = 200
[Step.1]
kind = route
points = 0 2  0.6 2  0.6 0
depth = 3.5
[Step.2]
kind = hold
duration = 5
)";

/** The ini and the mission of a short dive; `more` goes to the end of the ini. */
class CTinyMission
{
   public:
	explicit CTinyMission(const std::string& more = "", const std::string& mission = kTinyMission)
	{
		std::ofstream(folder / "tiny.ini") << tinySurveyIni() << "[ClosedLoop]\nmission = tiny-mission.ini\n"
										   << more;
		std::ofstream(folder / "tiny-mission.ini") << mission;
	}
	/** Runs it into `run`; further arguments at will. */
	void fly(CMissionApp& app, const std::string& run, std::vector<std::string> more = {}) const
	{
		std::vector<std::string> args{"-c", folder / "tiny.ini", "-o", folder / run};
		args.insert(args.end(), more.begin(), more.end());
		runApp(app, args);
	}
	CProgramFolder folder{"mission-" + std::to_string(made()++)};  ///< One shared by tests outlives them

   private:
	static int& made()
	{
		static int count = 0;
		return count;
	}
};
}  // namespace posidonia::testing
