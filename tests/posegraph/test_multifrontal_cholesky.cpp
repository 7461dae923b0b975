#include <gtest/gtest.h>
#include <posidonia/posegraph/multifrontal_cholesky.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>
#include <string>

#include <allocation_counter.h>

using namespace posidonia;

namespace
{
using TPositions = std::vector<CBlockMatrix::TPosition>;

/** Variables in `parts` graphs that share nothing: chains with chords. */
TPositions randomPairs(std::mt19937& rng, int n, int parts, int chords)
{
	TPositions pairs;
	for (int k = 1; k < n; k++)
		if (k % std::max(1, n / parts) != 0) pairs.push_back({k - 1, k});
	for (int k = 0; k < chords; k++) {
		const int part = std::max(1, n / parts), a = int(rng() % unsigned(n)),
				  b = a / part * part + int(rng() % unsigned(part));
		if (a != b && b < n) pairs.push_back({std::min(a, b), std::max(a, b)});
	}
	std::sort(pairs.begin(), pairs.end());
	pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
	return pairs;
}

/** H in the solver's order of elimination, and its solver. */
struct TSystem
{
	CMultifrontalCholesky cholesky;
	CBlockMatrix H;
	Eigen::VectorXd b;

	TSystem(int n, const TPositions& pairs, int threads = 1) : cholesky(threads)
	{
		const auto order = cholesky.order(n, pairs);
		std::vector<int> column(static_cast<size_t>(n));
		for (int k = 0; k < n; k++)
			column[size_t(order[size_t(k)])] = k;
		for (const auto& [a, b_] : pairs)
			m_below.push_back(
				{std::min(column[size_t(a)], column[size_t(b_)]),
				 std::max(column[size_t(a)], column[size_t(b_)])});
		std::sort(m_below.begin(), m_below.end());
		H.setPattern(n, m_below);
		cholesky.analyze(H);
	}

	/** Positive definite: a sum of J^T J over the pairs, and a little on the diagonal. */
	void fill(unsigned seed)
	{
		std::mt19937 rng(seed);
		std::normal_distribution<double> normal;
		const auto random = [&] {
			Matrix6d A;
			for (int k = 0; k < 36; k++)
				A(k) = normal(rng);
			return A;
		};
		H.setZero();
		for (int k = 0; k < H.blockCount(); k++)
			H.block(H.diagonalSlot(k)) += 0.5 * Matrix6d::Identity();
		for (const auto& [column, row] : m_below) {
			const Matrix6d A = random(), B = random();
			H.block(H.diagonalSlot(column)) += A.transpose() * A;
			H.block(H.diagonalSlot(row)) += B.transpose() * B;
			H.block(H.slot(row, column)) += B.transpose() * A;
		}
		b.resize(H.dimension());
		for (int k = 0; k < b.size(); k++)
			b[k] = normal(rng);
	}

	/** Bits of L and x. */
	std::string bytes()
	{
		const Eigen::VectorXd& x = cholesky.solve();
		std::string out(reinterpret_cast<const char*>(x.data()), size_t(x.size()) * sizeof(double));
		for (size_t c = 0; c < cholesky.forest().cliques.size(); c++) {
			const double* panel = cholesky.panel(int(c));
			// The first block column's rows down to the right-hand side, without the padding.
			const int rows = 6 * cholesky.forest().cliques[c].size() + 1;
			out.append(reinterpret_cast<const char*>(panel), size_t(rows) * sizeof(double));
		}
		return out;
	}

   private:
	TPositions m_below;
};

void expectSolved(TSystem& system, const std::string& where)
{
	ASSERT_TRUE(system.cholesky.factorize(system.H, system.b)) << where;
	const Eigen::VectorXd expected = system.H.toDense().ldlt().solve(system.b);
	EXPECT_LT((system.cholesky.solve() - expected).norm(), 1e-10 * expected.norm()) << where;
}
}  // namespace

TEST(MultifrontalCholesky, SolutionEqualsDenseLdlt)
{
	for (unsigned seed = 0; seed < 60; seed++) {
		std::mt19937 rng(seed);
		const int n = 1 + int(rng() % 70), parts = seed % 3 == 0 ? 4 : 1;
		TSystem system(n, randomPairs(rng, n, parts, int(seed) * n / 20), 1 + int(seed % 2));
		system.fill(seed);
		expectSolved(system, "seed=" + std::to_string(seed) + " n=" + std::to_string(n));
	}
}

TEST(MultifrontalCholesky, SolvesVariablesThatShareNothing)
{
	TSystem system(9, {});
	system.fill(1);
	expectSolved(system, "diagonal");
	EXPECT_EQ(system.cholesky.forest().cliques.size(), 9u);
}

TEST(MultifrontalCholesky, AnotherPatternMayFollow)
{
	std::mt19937 rng(8);
	TSystem system(50, randomPairs(rng, 50, 1, 60));
	system.fill(1);
	expectSolved(system, "first");
	system.cholesky.order(20, {});
	CBlockMatrix H;
	H.setPattern(20, {});
	H.setZero();
	for (int k = 0; k < 20; k++)
		H.block(H.diagonalSlot(k)) = (k + 1) * Matrix6d::Identity();
	system.cholesky.analyze(H);
	ASSERT_TRUE(system.cholesky.factorize(H, Eigen::VectorXd::Ones(120)));
	for (int k = 0; k < 120; k++)
		EXPECT_DOUBLE_EQ(system.cholesky.solve()[k], 1.0 / (k / 6 + 1)) << "k=" << k;
	EXPECT_EQ(system.cholesky.analyses(), 2u);
}

TEST(MultifrontalCholesky, ThreadsDoNotChangeTheBytes)
{
	for (unsigned seed = 0; seed < 10; seed++) {
		std::string bytes[3];
		for (int threads = 1; threads <= 3; threads++) {
			std::mt19937 rng(seed);
			TSystem system(300, randomPairs(rng, 300, seed % 2 ? 1 : 5, 80), threads);
			system.fill(seed);
			ASSERT_TRUE(system.cholesky.factorize(system.H, system.b)) << "seed=" << seed;
			bytes[threads - 1] = system.bytes();
		}
		EXPECT_TRUE(bytes[0] == bytes[1]) << "seed=" << seed << ", 2 threads";
		EXPECT_TRUE(bytes[0] == bytes[2]) << "seed=" << seed << ", 3 threads";
	}
}

TEST(MultifrontalCholesky, OtherValuesAreFactorisedWithoutAllocating)
{
	std::mt19937 rng(2);
	TSystem system(200, randomPairs(rng, 200, 2, 150));
	system.fill(1);
	expectSolved(system, "first values");
	system.fill(2);
	const size_t before = posidonia::testing::allocations();
	ASSERT_TRUE(system.cholesky.factorize(system.H, system.b));
	system.cholesky.solve();
	EXPECT_EQ(posidonia::testing::allocations() - before, 0u);
	expectSolved(system, "second values");
}

/** The first block column at which the leading minor of H is not positive definite. */
TEST(MultifrontalCholesky, NamesTheBlockThatIsNotPositiveDefinite)
{
	for (unsigned seed = 0; seed < 20; seed++)
		for (const int threads : {1, 2}) {
			std::mt19937 rng(seed);
			TSystem system(80, randomPairs(rng, 80, 1 + int(seed % 2), 30), threads);
			system.fill(seed);
			const int block = int(rng() % 80), row = 6 * block + int(rng() % 6);
			const Eigen::MatrixXd L = system.H.toDense().llt().matrixL();
			Eigen::VectorXd diagonal = system.H.diagonal();
			diagonal[row] -= 1.001 * L(row, row) * L(row, row);
			system.H.setDiagonal(diagonal);
			EXPECT_FALSE(system.cholesky.factorize(system.H, system.b)) << "seed=" << seed;
			EXPECT_EQ(system.cholesky.failedBlock(), block) << "seed=" << seed << " threads=" << threads;
			system.fill(seed);
			expectSolved(system, "after a failure, seed=" + std::to_string(seed));
		}
}

TEST(MultifrontalCholesky, RefusesWhatIsNotFinite)
{
	std::mt19937 rng(5);
	TSystem system(40, randomPairs(rng, 40, 1, 20));
	for (const double bad : {std::nan(""), HUGE_VAL})
		for (int block = 0; block < 40; block++) {
			system.fill(1);
			Eigen::VectorXd diagonal = system.H.diagonal();
			diagonal[6 * block + block % 6] = bad;
			system.H.setDiagonal(diagonal);
			EXPECT_FALSE(system.cholesky.factorize(system.H, system.b)) << bad << " in block " << block;
			EXPECT_EQ(system.cholesky.failedBlock(), block) << bad;
		}
}
