#pragma once

#include <posidonia/posegraph/block_matrix.h>
#include <posidonia/posegraph/elimination_forest.h>
#include <posidonia/posegraph/large_buffer.h>

namespace posidonia
{
struct TFrontKernels;

/** The SIMD kernels in use: "sse2", "avx2" or "avx512"; the best for this CPU, or those that the environment
 * variable POSIDONIA_SIMD names. Results differ in the last bits between them. */
const char* simdName();

/** H = L L^T of a symmetric matrix of 6x6 blocks by multifrontal elimination (Duff, Reid 1983; Liu 1992):
 * each clique of the elimination forest is a small dense matrix that its children are summed into. SIMD
 * kernels are chosen at run time. Ordering and symbolic analysis are done once a pattern; factorising
 * allocates nothing. */
class CMultifrontalCholesky
{
   public:
	/** @param threads subtrees of the forest eliminated at a time; the bytes of the result do not depend on
	 * it */
	explicit CMultifrontalCholesky(int threads = 1);

	/** Fill-reducing elimination order of the graph of blocks: order[k] = the variable eliminated k-th. H is
	 * to be laid out in this order.
	 * @param below pairs (a, b), a < b, of coupled variables, sorted, each once */
	const std::vector<int>& order(int block_count, const std::vector<CBlockMatrix::TPosition>& below);

	/** Where the blocks of H go. H has the pattern last given to order(), in that order. */
	void analyze(const CBlockMatrix& H);

	/** L and L^-1 b. False when H is not positive definite. */
	bool factorize(const CBlockMatrix& H, const Eigen::VectorXd& b);

	/** After a factorize() that failed: the block column where it broke down. */
	int failedBlock() const { return m_failed; }

	/** x with H x = b of the last factorize(). */
	const Eigen::VectorXd& solve();

	const TEliminationForest& forest() const { return m_forest; }
	/** The clique's columns of L: a front of size() blocks of which the first pivots(), see
	 * simd/front_kernels.h. */
	const double* panel(int clique) const { return m_panels.data() + m_panel_at[clique]; }
	/** For each block of the clique's separator, which block of the parent's front it is. */
	const int* rowsInParent(int clique) const { return m_rows.data() + m_rows_at[clique]; }
	const TFrontKernels& kernels() const { return m_kernels; }

	size_t analyses() const { return m_analyses; }
	size_t factorizations() const { return m_factorizations; }
	/** Doubles that L takes. */
	size_t factorSize() const { return m_panels.size(); }

   private:
	/** Cliques [first, last) in one go; a subtree, or what is above all of those. */
	struct TTask
	{
		int first, last;
	};

	void placePanels();
	void mapSeparators();
	void chooseTasks();
	void placeRests();
	bool eliminateRange(const TTask& task, const CBlockMatrix& H, const Eigen::VectorXd& b, int& failed);
	int eliminate(int clique, const CBlockMatrix& H, const Eigen::VectorXd& b);
	void assemble(int clique, const CBlockMatrix& H, const Eigen::VectorXd& b);
	double* rest(int clique) { return m_rests.data() + m_rest_at[clique]; }

	int m_threads;
	const TFrontKernels& m_kernels;
	TEliminationForest m_forest;
	std::vector<TTask> m_subtrees, m_top;
	std::vector<int> m_rows;	   ///< rowsInParent of all cliques, each ended by the parent's size
	std::vector<int> m_block_row;  ///< of each block of H: which block of its clique's front its row is
	std::vector<size_t> m_rows_at, m_panel_at, m_rest_at;
	CLargeBuffer m_panels, m_rests;
	Eigen::VectorXd m_x, m_local;
	std::vector<int> m_failures;  ///< of each subtree: the block column where it broke down, or -1
	int m_failed{-1};
	size_t m_analyses{0}, m_factorizations{0};
};
}  // namespace posidonia
