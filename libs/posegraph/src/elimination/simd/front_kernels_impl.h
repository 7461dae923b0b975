// Included once by each front_kernels_<cpu>.cpp, which is compiled for that CPU and defines KERNELS_WIDTH and
// KERNELS_NAME. Nothing of the standard library or Eigen may be included here: an inline function compiled
// for a newer CPU could be the copy that the linker keeps for everybody.
#include "front_kernels.h"

extern "C" double sqrt(double) noexcept;

namespace posidonia
{
namespace
{
constexpr int W = KERNELS_WIDTH;
typedef double TVector __attribute__((vector_size(W * 8)));
typedef double TUnaligned __attribute__((vector_size(W * 8), aligned(8), may_alias));

inline TVector load(const double* p)
{
	return *reinterpret_cast<const TUnaligned*>(p);
}
inline void store(double* p, TVector v)
{
	*reinterpret_cast<TUnaligned*>(p) = v;
}
inline int rowsInMemory(int m, int J)
{
	return paddedRows(m, J, W);
}

/** Block columns of L that are summed in one go: their rows stay in the cache, as does the packed factor. */
constexpr int kChunk = 32;

/** C(0 .. NV W - 1, 6 columns) -= A B^T (FRESH: C = -A B^T) over the block columns [first, last) of a panel
 * of m blocks. A's rows begin at scalar row `row` of the front; B is packed, 6 numbers a scalar column. */
template <int NV, bool FRESH>
inline void tile(
	double* C, int ldc, const double* panel, int m, int row, int first, int last, const double* packed)
{
	TVector acc[NV][6];
	for (int c = 0; c < 6; c++)
		for (int v = 0; v < NV; v++)
			acc[v][c] = FRESH ? TVector{} : load(C + c * ldc + v * W);
	for (int K = first; K < last; K++) {
		const int lda = rowsInMemory(m, K);
		const double* a = panel + blockColumnOffset(m, K, W) + (row - 6 * K);
		for (int k = 0; k < 6; k++, a += lda, packed += 6) {
			TVector A[NV];
			for (int v = 0; v < NV; v++)
				A[v] = load(a + v * W);
			for (int c = 0; c < 6; c++)
				for (int v = 0; v < NV; v++)
					acc[v][c] -= A[v] * packed[c];
		}
	}
	for (int c = 0; c < 6; c++)
		for (int v = 0; v < NV; v++)
			store(C + c * ldc + v * W, acc[v][c]);
}

/** Rows of block row J of the block columns [first, last), 6 numbers a scalar column. */
inline void pack(const double* panel, int m, int J, int first, int last, double* packed)
{
	for (int K = first; K < last; K++) {
		const int ld = rowsInMemory(m, K);
		const double* b = panel + blockColumnOffset(m, K, W) + 6 * (J - K);
		for (int k = 0; k < 6; k++, b += ld, packed += 6)
			for (int c = 0; c < 6; c++)
				packed[c] = b[c];
	}
}

template <bool FRESH>
inline void subtractChunk(
	double* C, int ldc, const double* panel, int m, int J, int first, int last, double* packed)
{
	const int rows = 6 * (m - J) + 1;
	pack(panel, m, J, first, last, packed);
	int r = 0;
	for (; r + W < rows; r += KERNELS_VECTORS * W)
		tile<KERNELS_VECTORS, FRESH>(C + r, ldc, panel, m, 6 * J + r, first, last, packed);
	for (; r < rows; r += W)
		tile<1, FRESH>(C + r, ldc, panel, m, 6 * J + r, first, last, packed);
}

/** C -= (rows from block row J on) (block row J)^T over the panel's first `columns` block columns; FRESH: C
 * is written, not read. */
template <bool FRESH>
inline void subtractProducts(double* C, int ldc, const double* panel, int m, int J, int columns)
{
	double packed[36 * kChunk];
	for (int first = 0; first < columns; first += kChunk) {
		const int last = first + kChunk < columns ? first + kChunk : columns;
		if (FRESH && first == 0)
			subtractChunk<true>(C, ldc, panel, m, J, first, last, packed);
		else
			subtractChunk<false>(C, ldc, panel, m, J, first, last, packed);
	}
}

/** The 6x6 block on top of C becomes its Cholesky factor; `inverse` the reciprocals of its diagonal. */
inline bool factorizeDiagonal(double* C, int ld, double* inverse)
{
	for (int j = 0; j < 6; j++) {
		double d = C[j * ld + j];
		for (int k = 0; k < j; k++)
			d -= C[k * ld + j] * C[k * ld + j];
		if (!(d > 0) || d > 1e300) return false;
		d = sqrt(d);
		C[j * ld + j] = d;
		inverse[j] = 1 / d;
		for (int i = j + 1; i < 6; i++) {
			double s = C[j * ld + i];
			for (int k = 0; k < j; k++)
				s -= C[k * ld + i] * C[k * ld + j];
			C[j * ld + i] = s * inverse[j];
		}
	}
	return true;
}

/** The rows below the diagonal block: X L^T = C. */
inline void solveBelow(double* C, int ld, int rows, const double* inverse)
{
	double L[6][6];
	for (int j = 0; j < 6; j++)
		for (int k = 0; k < j; k++)
			L[j][k] = C[k * ld + j];
	for (int r = 6; r < rows; r += W) {
		TVector x[6];
		for (int j = 0; j < 6; j++) {
			x[j] = load(C + j * ld + r);
			for (int k = 0; k < j; k++)
				x[j] -= x[k] * L[j][k];
			x[j] *= inverse[j];
		}
		for (int j = 0; j < 6; j++)
			store(C + j * ld + r, x[j]);
	}
}

int factorize(double* panel, int m, int pivots)
{
	for (int J = 0; J < pivots; J++) {
		double* C = panel + blockColumnOffset(m, J, W);
		const int ld = rowsInMemory(m, J);
		double inverse[6];
		subtractProducts<false>(C, ld, panel, m, J, J);
		if (!factorizeDiagonal(C, ld, inverse)) return J;
		solveBelow(C, ld, 6 * (m - J) + 1, inverse);
	}
	return -1;
}

void update(const double* panel, int m, int pivots, double* U)
{
	const int rest = m - pivots;
	for (int J = 0; J < rest; J++)
		subtractProducts<true>(
			U + blockColumnOffset(rest, J, W), rowsInMemory(rest, J), panel, m, pivots + J, pivots);
}

inline void add(double* to, const double* from, int n)
{
	int r = 0;
	for (; r + W <= n; r += W)
		store(to + r, load(to + r) + load(from + r));
	for (; r < n; r++)
		to[r] += from[r];
}

/** Block column a of a child's U into block column J = rows[a] of a front, in runs of neighbouring blocks;
 * the right-hand side ends the last. */
inline void addColumn(const double* U, int blocks, const int* rows, int a, double* to, int ld_to)
{
	const double* from = U + blockColumnOffset(blocks, a, W);
	const int ld_from = rowsInMemory(blocks, a);
	for (int b = a; b <= blocks;) {
		int end = b + 1;
		while (end <= blocks && rows[end] == rows[end - 1] + 1)
			end++;
		const int n = end <= blocks ? 6 * (end - b) : 6 * (blocks - b) + 1;
		for (int c = 0; c < 6; c++)
			add(to + c * ld_to + 6 * (rows[b] - rows[a]), from + c * ld_from + 6 * (b - a), n);
		b = end;
	}
}

void addToPanel(const double* U, int blocks, const int* rows, double* panel, int m, int pivots)
{
	for (int a = 0; a < blocks && rows[a] < pivots; a++)
		addColumn(U, blocks, rows, a, panel + blockColumnOffset(m, rows[a], W), rowsInMemory(m, rows[a]));
}

void addToRest(const double* U, int blocks, const int* rows, double* rest, int m, int pivots)
{
	int a = 0;
	while (a < blocks && rows[a] < pivots)
		a++;
	for (; a < blocks; a++)
		addColumn(
			U, blocks, rows, a, rest + blockColumnOffset(m - pivots, rows[a] - pivots, W),
			rowsInMemory(m, rows[a]));
}

/** C = -A X (FRESH) or C -= A X, for one tile of rows and six columns. */
template <int NV, bool FRESH>
inline void multiplyTile(const double* A, int lda, int n, const double* X, double* C, int ldc)
{
	TVector acc[NV][6];
	for (int c = 0; c < 6; c++)
		for (int v = 0; v < NV; v++)
			acc[v][c] = FRESH ? TVector{} : load(C + c * ldc + v * W);
	for (int k = 0; k < n; k++, A += lda, X += 6) {
		TVector a[NV];
		for (int v = 0; v < NV; v++)
			a[v] = load(A + v * W);
		for (int c = 0; c < 6; c++)
			for (int v = 0; v < NV; v++)
				acc[v][c] -= a[v] * X[c];
	}
	for (int c = 0; c < 6; c++)
		for (int v = 0; v < NV; v++)
			store(C + c * ldc + v * W, acc[v][c]);
}

/** Some columns of A: a tile of its rows is read once for all groups. */
template <bool FRESH>
inline void multiplyChunk(
	const double* A, int lda, int rows, int chunk, int n, const double* X, double* C, int ldc, int groups)
{
	int r = 0;
	for (; r + W < rows; r += KERNELS_VECTORS * W)
		for (int g = 0; g < groups; g++)
			multiplyTile<KERNELS_VECTORS, FRESH>(
				A + r, lda, chunk, X + 6 * g * size_t(n), C + r + 6 * g * size_t(ldc), ldc);
	for (; r < rows; r += W)
		for (int g = 0; g < groups; g++)
			multiplyTile<1, FRESH>(
				A + r, lda, chunk, X + 6 * g * size_t(n), C + r + 6 * g * size_t(ldc), ldc);
}

void multiply(const double* A, int lda, int rows, int n, const double* X, double* C, int ldc, int groups)
{
	constexpr int kColumns = 96;
	for (int k = 0; k < n || k == 0; k += kColumns) {
		const int chunk = n - k < kColumns ? n - k : kColumns;
		const double* from = A + size_t(k) * size_t(lda);
		if (k == 0)
			multiplyChunk<true>(from, lda, rows, chunk, n, X, C, ldc, groups);
		else
			multiplyChunk<false>(from, lda, rows, chunk, n, X + 6 * size_t(k), C, ldc, groups);
	}
}

inline double sum(TVector v)
{
	double s = 0;
	for (int i = 0; i < W; i++)
		s += v[i];
	return s;
}

/** Columns . x over `rows` rows. */
inline void dot6(const double* C, int ld, const double* x, int rows, double* out)
{
	TVector acc[6] = {};
	int r = 0;
	for (; r + W <= rows; r += W) {
		const TVector xv = load(x + r);
		for (int c = 0; c < 6; c++)
			acc[c] += load(C + c * ld + r) * xv;
	}
	for (int c = 0; c < 6; c++) {
		out[c] = sum(acc[c]);
		for (int k = r; k < rows; k++)
			out[c] += C[c * ld + k] * x[k];
	}
}

void backSubstitute(const double* panel, int m, int pivots, double* x)
{
	for (int J = pivots - 1; J >= 0; J--) {
		const double* C = panel + blockColumnOffset(m, J, W);
		const int ld = rowsInMemory(m, J), below = 6 * (m - J);
		double s[6];
		dot6(C + 6, ld, x + 6 * (J + 1), below - 6, s);
		for (int j = 5; j >= 0; j--) {
			double v = C[j * ld + below] - s[j];
			for (int i = j + 1; i < 6; i++)
				v -= C[j * ld + i] * x[6 * J + i];
			x[6 * J + j] = v / C[j * ld + j];
		}
	}
}
}  // namespace

extern const TFrontKernels KERNELS_TABLE;
const TFrontKernels KERNELS_TABLE{KERNELS_NAME, W,		   factorize,	   update,
								  addToPanel,	addToRest, backSubstitute, multiply};
}  // namespace posidonia
