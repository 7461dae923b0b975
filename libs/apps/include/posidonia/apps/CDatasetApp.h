#pragma once

#include <posidonia/apps/command_line.h>
#include <posidonia/dataset/import_dataset.h>

namespace posidonia
{
/** auv-dataset2rawlog: an EuRoC (ASL) folder with an AUV's sensors, or a folder with DVL.csv and GT.csv, as a
 * rawlog. */
class CDatasetApp
{
   public:
	static constexpr const char* name = "auv-dataset2rawlog";

	/** False when --help, --version or --dump-config was answered. Throws CError, CUsageError. */
	bool initialize(int argc, const char* const* argv);
	void run();

	const TDatasetReport& results() const { return m_report; }
	TDatasetOptions params;

   private:
	int m_verbosity{1};
	TDatasetReport m_report;
};
}  // namespace posidonia
