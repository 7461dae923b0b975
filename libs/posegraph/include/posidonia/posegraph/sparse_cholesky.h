#pragma once

#include <posidonia/posegraph/block_matrix.h>

#include <memory>

namespace posidonia
{
/** H = L L^T by CHOLMOD's supernodal factorisation (Chen, Davis, Hager, Rajamanickam 2008). The one door to
 * CHOLMOD, whose supernodal module is GPL-2+. Making one sets OpenBLAS, when it is the BLAS, to one thread in
 * the whole program: its sums depend on the number of threads. */
class CSparseCholesky
{
   public:
	CSparseCholesky();
	~CSparseCholesky();
	CSparseCholesky(CSparseCholesky&&) noexcept;
	CSparseCholesky& operator=(CSparseCholesky&&) noexcept;

	/** Fill-reducing elimination order (approximate minimum degree, postordered) of the graph of blocks:
	 * order[k] = the variable eliminated k-th. Ordering blocks instead of scalars costs 1/36.
	 * @param below pairs (a, b), a < b, of coupled variables, each once */
	std::vector<int> eliminationOrder(int block_count, const std::vector<CBlockMatrix::TPosition>& below);

	/** Symbolic analysis of H, whose blocks are already in elimination order. */
	void analyze(const CBlockMatrix& H);

	/** L from the values of H, of the analysed pattern. False when H is not positive definite. */
	bool factorize(const CBlockMatrix& H);

	/** After a factorize() that failed: the block column where it broke down. */
	int failedBlock() const;

	/** x with H x = b. */
	const Eigen::VectorXd& solve(const Eigen::VectorXd& b);

	/** L^-1 B, so that A^T H^-1 B = halfSolve(A)^T halfSolve(B). @param B dimension x k */
	Eigen::MatrixXd halfSolve(const Eigen::MatrixXd& B);

	size_t analyses() const;		///< symbolic analyses done so far
	size_t factorizations() const;	///< numeric factorisations tried so far
	double factorNonzeros() const;	///< entries of L as CHOLMOD counts them

   private:
	struct TImpl;
	std::unique_ptr<TImpl> m_impl;
};
}  // namespace posidonia
