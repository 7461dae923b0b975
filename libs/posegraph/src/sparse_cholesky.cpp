#include <cholmod.h>
#include <posidonia/base/error.h>
#include <posidonia/posegraph/sparse_cholesky.h>

// Of OpenBLAS and of the OpenMP run time that CHOLMOD may bring; absent (null) otherwise.
extern "C" {
void openblas_set_num_threads(int) __attribute__((weak));
int omp_get_max_active_levels() __attribute__((weak));
void omp_set_max_active_levels(int) __attribute__((weak));
}

namespace posidonia
{
namespace
{
/** Keeps CHOLMOD's OpenMP loops on this thread while it lives. Four threads are compiled into CHOLMOD, and
 * for our small supernodes their barriers cost more than they gain: on a busy machine a thousand times more.
 */
class COneThread
{
   public:
	COneThread() : m_levels(omp_get_max_active_levels ? omp_get_max_active_levels() : 0) { set(0); }
	COneThread(const COneThread&) = delete;
	COneThread& operator=(const COneThread&) = delete;
	~COneThread() { set(m_levels); }

   private:
	static void set(int levels)
	{
		if (omp_set_max_active_levels) omp_set_max_active_levels(levels);
	}
	int m_levels;
};

/** A CHOLMOD view of scalar compressed columns; it owns nothing. */
cholmod_sparse viewOf(
	int dimension, const std::vector<int>& starts, const std::vector<int>& rows, const double* values)
{
	cholmod_sparse view{};
	view.nrow = view.ncol = dimension;
	view.nzmax = rows.size();
	// CHOLMOD takes plain pointers and leaves its input alone.
	view.p = const_cast<int*>(starts.data());
	view.i = const_cast<int*>(rows.data());
	view.x = const_cast<double*>(values);
	view.stype = -1;  // symmetric; what lies above the diagonal is ignored
	view.itype = CHOLMOD_INT;
	view.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
	view.dtype = CHOLMOD_DOUBLE;
	view.sorted = view.packed = 1;
	return view;
}

cholmod_sparse viewOf(const CBlockMatrix& H)
{
	return viewOf(H.dimension(), H.columnStarts(), H.rows(), H.values().data());
}

cholmod_dense viewOf(const double* data, size_t rows, size_t columns)
{
	cholmod_dense view{};
	view.nrow = view.d = rows;
	view.ncol = columns;
	view.nzmax = rows * columns;
	view.x = const_cast<double*>(data);
	view.xtype = CHOLMOD_REAL;
	view.dtype = CHOLMOD_DOUBLE;
	return view;
}
}  // namespace

struct CSparseCholesky::TImpl
{
	cholmod_common common;
	cholmod_factor* L{nullptr};
	cholmod_dense *X{nullptr}, *Y{nullptr}, *E{nullptr};  // workspace of solve, kept between calls
	Eigen::VectorXd x;
	size_t analyses{0}, factorizations{0};

	TImpl()
	{
		if (openblas_set_num_threads) openblas_set_num_threads(1);
		cholmod_start(&common);
		common.print = 0;
		common.quick_return_if_not_posdef = 1;
		common.nmethods = 1;
	}
	TImpl(const TImpl&) = delete;
	TImpl& operator=(const TImpl&) = delete;
	~TImpl()
	{
		cholmod_free_factor(&L, &common);
		cholmod_free_dense(&X, &common);
		cholmod_free_dense(&Y, &common);
		cholmod_free_dense(&E, &common);
		cholmod_finish(&common);
	}

	cholmod_factor* analyze(cholmod_sparse& A, int ordering, int supernodal)
	{
		common.method[0].ordering = ordering;
		common.postorder = ordering != CHOLMOD_NATURAL;	 // a natural order is a postorder already
		common.supernodal = supernodal;
		cholmod_factor* factor = cholmod_analyze(&A, &common);
		check(factor != nullptr);
		return factor;
	}

	/** Negative states are errors (no memory, too large); a matrix that is not positive definite is a
	 * warning. */
	void check(bool done) const
	{
		if (done && common.status >= 0) return;
		throw CError(
			"sparse Cholesky", "CHOLMOD failed with status " + std::to_string(common.status),
			common.status == CHOLMOD_OUT_OF_MEMORY ? "the graph needs more memory" : "report this");
	}

	void solve(int system, const cholmod_dense& B)
	{
		check(
			cholmod_solve2(system, L, const_cast<cholmod_dense*>(&B), nullptr, &X, nullptr, &Y, &E, &common));
	}
};

CSparseCholesky::CSparseCholesky() : m_impl(std::make_unique<TImpl>()) {}
CSparseCholesky::~CSparseCholesky() = default;
CSparseCholesky::CSparseCholesky(CSparseCholesky&&) noexcept = default;
CSparseCholesky& CSparseCholesky::operator=(CSparseCholesky&&) noexcept = default;

std::vector<int> CSparseCholesky::eliminationOrder(
	int block_count, const std::vector<CBlockMatrix::TPosition>& below)
{
	if (block_count == 0) return {};
	std::vector<int> starts(block_count + 1, 0), rows;
	auto next = below.begin();
	for (int c = 0; c < block_count; c++) {
		rows.push_back(c);
		for (; next != below.end() && (*next)[0] == c; ++next)
			rows.push_back((*next)[1]);
		starts[c + 1] = int(rows.size());
	}
	cholmod_sparse pattern = viewOf(block_count, starts, rows, nullptr);
	cholmod_factor* symbolic = m_impl->analyze(pattern, CHOLMOD_AMD, CHOLMOD_SIMPLICIAL);
	const int* order = static_cast<int*>(symbolic->Perm);
	std::vector<int> out(order, order + block_count);
	cholmod_free_factor(&symbolic, &m_impl->common);
	return out;
}

void CSparseCholesky::analyze(const CBlockMatrix& H)
{
	cholmod_free_factor(&m_impl->L, &m_impl->common);
	cholmod_sparse A = viewOf(H);
	m_impl->L = m_impl->analyze(A, CHOLMOD_NATURAL, CHOLMOD_SUPERNODAL);
	m_impl->analyses++;
}

bool CSparseCholesky::factorize(const CBlockMatrix& H)
{
	const COneThread one_thread;
	cholmod_sparse A = viewOf(H);
	m_impl->factorizations++;
	m_impl->check(cholmod_factorize(&A, m_impl->L, &m_impl->common));
	return m_impl->L->minor == m_impl->L->n;
}

int CSparseCholesky::failedBlock() const
{
	return int(m_impl->L->minor / 6);
}

const Eigen::VectorXd& CSparseCholesky::solve(const Eigen::VectorXd& b)
{
	m_impl->solve(CHOLMOD_A, viewOf(b.data(), b.size(), 1));
	m_impl->x = Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(m_impl->X->x), b.size());
	return m_impl->x;
}

Eigen::MatrixXd CSparseCholesky::halfSolve(const Eigen::MatrixXd& B)
{
	m_impl->solve(CHOLMOD_L, viewOf(B.data(), B.rows(), B.cols()));
	return Eigen::Map<const Eigen::MatrixXd>(static_cast<double*>(m_impl->X->x), B.rows(), B.cols());
}

size_t CSparseCholesky::analyses() const
{
	return m_impl->analyses;
}
size_t CSparseCholesky::factorizations() const
{
	return m_impl->factorizations;
}
double CSparseCholesky::factorNonzeros() const
{
	return m_impl->common.lnz;
}
}  // namespace posidonia
