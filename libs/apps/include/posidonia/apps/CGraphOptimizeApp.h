#pragma once

#include <posidonia/apps/command_line.h>
#include <posidonia/apps/graph_files.h>
#include <posidonia/apps/graph_solvers.h>
#include <posidonia/apps/process_meter.h>

namespace posidonia
{
/** auv-graph-optimize: a pose graph from a file, optimised, to a file. */
class CGraphOptimizeApp
{
   public:
	static constexpr const char* name = "auv-graph-optimize";

	/** False when --help, --version or --dump-config was answered. Throws CError, CUsageError. */
	bool initialize(int argc, const char* const* argv);
	void run();
	/** 0; 3 when the solver did not converge: the files are written and hold what it reached. */
	int exitStatus() const { return m_results.solution.converged ? 0 : 3; }

	struct TParams
	{
		std::string input, output;	///< The latter may be empty: nothing is written
		std::string solver{"batch"}, start{"file"};
		TRobustChoice robust;
		TOptimizerOptions optimizer;			   ///< [GraphOptimizer]
		std::string marginals_file, weights_file;  ///< Empty: not written
		bool json{false};
	};
	TParams params;

	struct TResults
	{
		TGraphSolution solution;
		double chi2_before{0};	///< Plain chi2 of the file's poses
		double chi2_start{0};	///< After --init
		double chi2_after{0};
		double chi2_kept{0};	 ///< chi2_after of the edges that are no outliers
		double reduced_chi2{0};	 ///< chi2_kept a degree of freedom that these leave; 0 without redundancy
		size_t nodes{0}, edges{0};
		int outliers{0};		   ///< Edges of weight below one half
		std::string start;		   ///< What --init did
		CStageMeter::TStage cost;  ///< Of set-up and optimisation, without files and marginals
		double peak_memory_mb{0};
	};
	const TResults& results() const { return m_results; }
	const CPoseGraph& graph() const { return m_file.graph; }

   private:
	void optimize(CStageMeter& meter);
	void evaluate();
	void writeFiles(CStageMeter& meter);
	void report(const CStageMeter& meter) const;
	std::string text(const CStageMeter& meter) const;
	std::string jsonText(const CStageMeter& meter) const;

	int m_verbosity{1};
	TGraphFile m_file;
	TResults m_results;
};
}  // namespace posidonia
