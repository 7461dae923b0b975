#include <elimination/simd/front_kernels.h>
#include <gtest/gtest.h>
#include <posidonia/base/error.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

using namespace posidonia;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

MatrixXd randomMatrix(std::mt19937& rng, int rows, int columns)
{
	std::normal_distribution<double> normal;
	MatrixXd A(rows, columns);
	for (int k = 0; k < A.size(); k++)
		A(k) = normal(rng);
	return A;
}

/** The front's memory: the first `columns` block columns of a dense (6 m + 1) x 6 m front, whose last row is
 * the right-hand side. What no kernel may depend on is not a number. */
std::vector<double> packed(const MatrixXd& front, int m, int columns, int width)
{
	std::vector<double> out(frontSize(m, columns, width), kNan);
	for (int J = 0; J < columns; J++)
		for (int c = 0; c < 6; c++)
			for (int r = 6 * J; r <= 6 * m; r++)
				out[blockColumnOffset(m, J, width) + size_t(c * paddedRows(m, J, width) + r - 6 * J)] =
					front(r, 6 * J + c);
	return out;
}

/** The reverse; zero above the diagonal. */
MatrixXd unpacked(const std::vector<double>& memory, int m, int columns, int width)
{
	MatrixXd out = MatrixXd::Zero(6 * m + 1, 6 * columns);
	for (int J = 0; J < columns; J++)
		for (int c = 0; c < 6; c++)
			for (int r = 6 * J + c; r <= 6 * m; r++)
				out(r, 6 * J + c) =
					memory[blockColumnOffset(m, J, width) + size_t(c * paddedRows(m, J, width) + r - 6 * J)];
	return out;
}

/** Dense and by other means. */
struct TDenseFront
{
	int m, pivots;
	MatrixXd A;	 ///< 6 m x 6 m, positive definite
	VectorXd b;

	TDenseFront(unsigned seed, int m_, int pivots_) : m(m_), pivots(pivots_)
	{
		std::mt19937 rng(seed);
		const MatrixXd B = randomMatrix(rng, 6 * m, 6 * m);
		A = B * B.transpose() + 6 * m * MatrixXd::Identity(6 * m, 6 * m);
		b = randomMatrix(rng, 6 * m, 1);
	}
	MatrixXd front() const
	{
		MatrixXd out(6 * m + 1, 6 * m);
		out << A, b.transpose();
		return out;
	}
	MatrixXd L() const { return A.llt().matrixL(); }
};

double relativeError(const MatrixXd& got, const MatrixXd& expected)
{
	return (got - expected).norm() / std::max(expected.norm(), 1e-300);
}

struct TSize
{
	int m, pivots;
};
const TSize kSizes[] = {{1, 1}, {2, 1},	  {2, 2},	{3, 1},	  {5, 2},	{7, 7}, {8, 3},
						{9, 1}, {16, 15}, {21, 10}, {40, 33}, {70, 68}, {70, 2}};

class FrontKernels : public ::testing::TestWithParam<const TFrontKernels*>
{
   protected:
	const TFrontKernels& k = *GetParam();
	std::vector<double> factorized(const TDenseFront& dense)
	{
		auto panel = packed(dense.front(), dense.m, dense.pivots, k.width);
		EXPECT_EQ(k.factorize(panel.data(), dense.m, dense.pivots), -1);
		return panel;
	}
};
}  // namespace

INSTANTIATE_TEST_SUITE_P(
	OfThisCpu, FrontKernels, ::testing::ValuesIn(availableFrontKernels()),
	[](const auto& info) { return std::string(info.param->name); });

TEST_P(FrontKernels, FactorizeEqualsDenseCholesky)
{
	for (const auto& [m, p] : kSizes) {
		const TDenseFront dense(unsigned(m), m, p);
		const MatrixXd got = unpacked(factorized(dense), m, p, k.width), L = dense.L();
		const VectorXd y =
			L.topLeftCorner(6 * p, 6 * p).triangularView<Eigen::Lower>().solve(dense.b.head(6 * p));
		EXPECT_LT(relativeError(got.topRows(6 * m), L.leftCols(6 * p)), 1e-12) << "m=" << m << " p=" << p;
		EXPECT_LT(relativeError(got.bottomRows(1), y.transpose()), 1e-12) << "m=" << m << " p=" << p;
	}
}

TEST_P(FrontKernels, UpdateLeavesTheSchurComplement)
{
	for (const auto& [m, p] : kSizes) {
		const TDenseFront dense(unsigned(m) + 1, m, p);
		const auto panel = factorized(dense);
		const int rest = m - p;
		std::vector<double> U(frontSize(rest, rest, k.width), kNan);
		k.update(panel.data(), m, p, U.data());
		if (rest == 0) continue;
		const MatrixXd A11 = dense.A.topLeftCorner(6 * p, 6 * p),
					   A21 = dense.A.bottomLeftCorner(6 * rest, 6 * p);
		const auto ldlt = A11.ldlt();
		const MatrixXd S = -A21 * ldlt.solve(A21.transpose());
		const VectorXd right = -A21 * ldlt.solve(dense.b.head(6 * p));
		const MatrixXd got = unpacked(U, rest, rest, k.width);
		EXPECT_LT(relativeError(got.topRows(6 * rest), MatrixXd(S.triangularView<Eigen::Lower>())), 1e-12)
			<< "m=" << m << " p=" << p;
		EXPECT_LT(relativeError(got.bottomRows(1), right.transpose()), 1e-12) << "m=" << m << " p=" << p;
	}
}

TEST_P(FrontKernels, BackSubstituteFindsTheSolution)
{
	for (const auto& [m, p] : kSizes) {
		const TDenseFront dense(unsigned(m) + 2, m, p);
		const auto panel = factorized(dense);
		const VectorXd x = dense.A.ldlt().solve(dense.b);
		VectorXd got = x;
		got.head(6 * p).setConstant(kNan);
		k.backSubstitute(panel.data(), m, p, got.data());
		EXPECT_LT(relativeError(got, x), 1e-12) << "m=" << m << " p=" << p;
		EXPECT_EQ(got.tail(6 * (m - p)), x.tail(6 * (m - p))) << "m=" << m << " p=" << p;
	}
}

TEST_P(FrontKernels, AChildIsSummedIntoItsParent)
{
	std::mt19937 rng(4);
	for (int trial = 0; trial < 200; trial++) {
		const int m = 1 + int(rng() % 12), p = 1 + int(rng() % unsigned(m));
		std::vector<int> rows;
		for (int j = 0; j < m; j++)
			if (rng() % 3 > 0) rows.push_back(j);
		const int blocks = int(rows.size());
		rows.push_back(m);
		const MatrixXd child = randomMatrix(rng, 6 * blocks + 1, 6 * blocks),
					   before = randomMatrix(rng, 6 * m + 1, 6 * m);
		MatrixXd after = before;
		for (int a = 0; a < blocks; a++)
			for (int c = 0; c < 6; c++) {
				for (int b = a; b < blocks; b++)
					after.block<6, 1>(6 * rows[size_t(b)], 6 * rows[size_t(a)] + c) +=
						child.block<6, 1>(6 * b, 6 * a + c);
				after(6 * m, 6 * rows[size_t(a)] + c) += child(6 * blocks, 6 * a + c);
			}
		const auto U = packed(child, blocks, blocks, k.width);
		auto panel = packed(before, m, p, k.width);
		auto rest = packed(before.bottomRightCorner(6 * (m - p) + 1, 6 * (m - p)), m - p, m - p, k.width);
		k.addToPanel(U.data(), blocks, rows.data(), panel.data(), m, p);
		k.addToRest(U.data(), blocks, rows.data(), rest.data(), m, p);
		EXPECT_EQ(unpacked(panel, m, p, k.width), unpacked(packed(after, m, p, k.width), m, p, k.width))
			<< "trial " << trial << " m=" << m << " p=" << p << " blocks=" << blocks;
		const auto expected =
			packed(after.bottomRightCorner(6 * (m - p) + 1, 6 * (m - p)), m - p, m - p, k.width);
		EXPECT_EQ(unpacked(rest, m - p, m - p, k.width), unpacked(expected, m - p, m - p, k.width))
			<< "trial " << trial << " m=" << m << " p=" << p << " blocks=" << blocks;
	}
}

TEST_P(FrontKernels, MultiplyEqualsTheDenseProduct)
{
	std::mt19937 rng(6);
	for (const auto& [rows, n, groups] :
		 {std::array{1, 1, 1},
		  {6, 6, 1},
		  {7, 5, 2},
		  {6, 97, 3},
		  {48, 96, 8},
		  {31, 200, 2},
		  {100, 30, 8},
		  {9, 0, 2}})
	{
		const MatrixXd A = randomMatrix(rng, rows, n), X = randomMatrix(rng, n, 6 * groups);
		const int ld = rows + k.width;
		std::vector<double> a(size_t(ld) * size_t(n) + size_t(k.width), kNan), x,
			c(size_t(ld) * size_t(6 * groups) + size_t(k.width), kNan);
		for (int j = 0; j < n; j++)
			for (int i = 0; i < rows; i++)
				a[size_t(j * ld + i)] = A(i, j);
		for (int g = 0; g < groups; g++)
			for (int i = 0; i < n; i++)
				for (int j = 0; j < 6; j++)
					x.push_back(X(i, 6 * g + j));
		k.multiply(a.data(), ld, rows, n, x.data(), c.data(), ld, groups);
		const Eigen::Map<const MatrixXd, 0, Eigen::OuterStride<>> C(
			c.data(), rows, 6 * groups, Eigen::OuterStride<>(ld));
		const MatrixXd expected = -A * X;
		EXPECT_LE((C - expected).norm(), 1e-13 * expected.norm()) << rows << " x " << n << ", " << groups;
	}
}

TEST_P(FrontKernels, TheBlockColumnThatIsNotPositiveDefiniteIsNamed)
{
	constexpr int kM = 11, kPivots = 9;
	for (int J = 0; J < kPivots; J++)
		for (int i = 0; i < 6; i++) {
			TDenseFront dense(3, kM, kPivots);
			const int row = 6 * J + i;
			const double pivot = dense.L()(row, row);
			dense.A(row, row) -= 1.001 * pivot * pivot;	 // this pivot becomes a little negative
			auto panel = packed(dense.front(), kM, kPivots, k.width);
			EXPECT_EQ(k.factorize(panel.data(), kM, kPivots), J) << "row " << row;
		}
	MatrixXd zero = MatrixXd::Zero(7, 6);
	auto panel = packed(zero, 1, 1, k.width);
	EXPECT_EQ(k.factorize(panel.data(), 1, 1), 0) << "all zeros";
}

TEST_P(FrontKernels, TheBlockColumnThatIsNotFiniteIsNamed)
{
	constexpr int kM = 11, kPivots = 9;
	for (const double bad : {kNan, kInf, -kInf})
		for (int J = 0; J < kPivots; J++)
			for (int i = 0; i < 6; i++) {
				TDenseFront dense(3, kM, kPivots);
				dense.A(6 * J + i, 6 * J + i) = bad;
				auto panel = packed(dense.front(), kM, kPivots, k.width);
				EXPECT_EQ(k.factorize(panel.data(), kM, kPivots), J) << bad << ", row " << 6 * J + i;
			}
	for (const double bad : {kNan, kInf}) {	 // off the diagonal: where it reaches a diagonal
		TDenseFront dense(3, kM, kPivots);
		dense.A(6 * 7 + 2, 6 * 1 + 3) = bad;
		auto panel = packed(dense.front(), kM, kPivots, k.width);
		EXPECT_EQ(k.factorize(panel.data(), kM, kPivots), 7) << bad;
	}
}

/** In a process of its own, since the choice is made once. */
TEST(FrontKernelsChoice, FollowsTheEnvironment)
{
	GTEST_FLAG_SET(death_test_style, "threadsafe");
	for (const auto* kernels : availableFrontKernels())
		EXPECT_EXIT(
			{
				setenv("POSIDONIA_SIMD", kernels->name, 1);
				std::exit(&frontKernels() == kernels ? 0 : 1);
			},
			::testing::ExitedWithCode(0), "")
			<< kernels->name;
	EXPECT_EXIT(
		{
			unsetenv("POSIDONIA_SIMD");
			std::exit(&frontKernels() == availableFrontKernels().back() ? 0 : 1);
		},
		::testing::ExitedWithCode(0), "");
	EXPECT_EXIT(
		{
			setenv("POSIDONIA_SIMD", "abacus", 1);
			try {
				frontKernels();
			}
			catch (const CError& error) {
				std::exit(std::string(error.what()).find("abacus") != std::string::npos ? 0 : 1);
			}
			std::exit(2);
		},
		::testing::ExitedWithCode(0), "");
}
