#pragma once

#include <posidonia/apps/command_line.h>
#include <posidonia/report/run_report.h>

#include <string>

namespace posidonia
{
/** auv-report: the report, plots and exports of a run, from its folder alone. */
class CReportApp
{
   public:
	static constexpr const char* name = "auv-report";

	/** False when --help or --version was answered. Throws CError, CUsageError. */
	bool initialize(int argc, const char* const* argv);
	void run();

	struct TResults
	{
		std::string page;  ///< report.html
	};
	const TResults& results() const { return m_results; }

   private:
	std::string m_folder, m_output;
	TResults m_results;
	int m_verbosity{1};
};
}  // namespace posidonia
