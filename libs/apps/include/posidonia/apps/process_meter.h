#pragma once

#include <string>
#include <vector>

namespace posidonia
{
/** CPU time of the process, all threads [s], since it began. */
double processCpuSeconds();

/** Largest resident memory of the process so far [MB = 1e6 bytes]. */
double peakMemoryMb();

/** Time of the stages of a job, for reports only: no result depends on it. */
class CStageMeter
{
   public:
	struct TStage
	{
		std::string name;
		double cpu{0}, wall{0};	 ///< [s]
	};

	CStageMeter();
	/** Ends the stage that has run since the last call (or the beginning), under this name. */
	void end(const std::string& stage);

	const std::vector<TStage>& stages() const { return m_stages; }
	/** Sum over the stages of these names; names that never ran count nothing. */
	TStage sum(const std::vector<std::string>& names) const;

   private:
	double m_cpu, m_wall;
	std::vector<TStage> m_stages;
};
}  // namespace posidonia
