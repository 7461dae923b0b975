#pragma once

#include <posidonia/apps/command_line.h>
#include <posidonia/apps/run_summary.h>
#include <posidonia/apps/scoring.h>

#include <optional>

namespace posidonia
{
/** auv-eval: trajectories and runs against the truth; several runs as one table. */
class CEvalApp
{
   public:
	static constexpr const char* name = "auv-eval";

	/** False when --help, --version or --dump-config was answered. Throws CError, CUsageError. */
	bool initialize(int argc, const char* const* argv);
	void run();

	struct TResults
	{
		/** Of all inputs; with several inputs each row starts with "<input's name>." */
		TMetrics metrics;
		std::optional<TSummary> summary;  ///< With --summary
	};
	const TResults& results() const { return m_results; }

   private:
	/** A trajectory file or a run folder, and how it is judged. */
	struct TInput
	{
		std::string path, name;
		TScoring scoring;
	};
	TInput inputOf(const std::string& path, const CCommandLine& line) const;
	void nameInputs();
	void refuseOverwritingInputs() const;
	void evaluate();
	void summarizeRuns();
	/** The table or, with --json, the rows; and the files of -o. */
	void hand(const std::string& table) const;

	std::vector<TInput> m_inputs;
	std::string m_truth, m_output;
	std::vector<EAlignment> m_alignments;
	bool m_summary{false}, m_json{false};
	TResults m_results;
};
}  // namespace posidonia
