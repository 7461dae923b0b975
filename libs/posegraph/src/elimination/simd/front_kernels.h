#pragma once

#include <cstddef>
#include <vector>

namespace posidonia
{
/** Dense kernels of one front of the multifrontal elimination, for one kind of CPU.
 *
 * A front of m blocks is the lower trapezoid of a symmetric matrix of 6x6 blocks with the right-hand side as
 * one more row at the bottom. Block column J is a dense column-major array of 6 columns: rows 6 J .. 6 m (the
 * last is the right-hand side), `paddedRows` of them, the rest padding that any kernel may overwrite. Block
 * columns lie one after the other, so that everything follows from m alone. */
struct TFrontKernels
{
	const char* name;  ///< "sse2", "avx2", "avx512"
	int width;		   ///< doubles in a vector

	/** Partial Cholesky: the first `pivots` block columns of a front of m blocks become those of L, the
	 * right-hand side's row L^-1 b. Returns the block column where the matrix is not positive definite, else
	 * -1. */
	int (*factorize)(double* panel, int m, int pivots);

	/** What the pivots leave of the rest of the front, which is a front of m - pivots blocks of its own:
	 * U = -L2 L2^T. */
	void (*update)(const double* panel, int m, int pivots, double* U);

	/** Sums the part of a child's U (a front of `blocks` blocks) that belongs to its parent's pivots into the
	 * parent's panel of m blocks. `rows`: for each of the child's blocks, ascending, which of the parent's it
	 * is, and m at the end for the right-hand side. */
	void (*addToPanel)(const double* U, int blocks, const int* rows, double* panel, int m, int pivots);

	/** The other part, into what the parent leaves itself. */
	void (*addToRest)(const double* U, int blocks, const int* rows, double* rest, int m, int pivots);

	/** Back-substitution of a factorised panel. `x`: 6 m numbers; on entry those after the pivots hold the
	 * solution of the separator, on return the first 6 `pivots` that of the pivots. */
	void (*backSubstitute)(const double* panel, int m, int pivots, double* x);

	/** C = -A X: A of rows x n, C of rows x 6 `groups`. X in groups of six columns, each n x 6 row by row.
	 * Columns of A and C have room for a whole vector after their end. */
	void (*multiply)(
		const double* A, int lda, int rows, int n, const double* X, double* C, int ldc, int groups);
};

/** Those that this CPU can run, best last. */
std::vector<const TFrontKernels*> availableFrontKernels();

/** Best kernels for this CPU, or those named by the environment variable POSIDONIA_SIMD (sse2, avx2, avx512)
 * when the CPU has them; chosen once. Results differ in the last bits between them. */
const TFrontKernels& frontKernels();

/** Rows of block column J of a front of m blocks in memory. The padding lets a kernel finish with a whole
 * vector. */
inline int paddedRows(int m, int J, int width)
{
	return 6 * (m - J) + width;
}

/** Where block column J of a front of m blocks starts. */
inline size_t blockColumnOffset(int m, int J, int width)
{
	return 36 * (size_t(m) * size_t(J) - size_t(J) * size_t(J - 1) / 2) + 6 * size_t(width) * size_t(J);
}

/** Doubles of the first `columns` block columns of a front of m blocks. */
inline size_t frontSize(int m, int columns, int width)
{
	return blockColumnOffset(m, columns, width);
}

extern const TFrontKernels kFrontKernelsSse2;
#ifdef POSIDONIA_X86
extern const TFrontKernels kFrontKernelsAvx2, kFrontKernelsAvx512;
#endif
}  // namespace posidonia
