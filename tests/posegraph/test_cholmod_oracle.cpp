// CHOLMOD solves the same systems.
#include <cholmod.h>
#include <gtest/gtest.h>
#include <posidonia/posegraph/normal_equations.h>

#include "random_graph.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
Eigen::VectorXd solveWithCholmod(const Eigen::MatrixXd& H, const Eigen::VectorXd& b)
{
	cholmod_common common;
	cholmod_start(&common);
	cholmod_dense dense{};
	dense.nrow = dense.ncol = dense.d = size_t(H.rows());
	dense.nzmax = size_t(H.size());
	dense.x = const_cast<double*>(H.data());
	dense.xtype = CHOLMOD_REAL;
	cholmod_sparse* A = cholmod_dense_to_sparse(&dense, 1, &common);
	A->stype = -1;
	common.supernodal = CHOLMOD_SUPERNODAL;
	cholmod_factor* L = cholmod_analyze(A, &common);
	cholmod_factorize(A, L, &common);
	cholmod_dense right = dense;
	right.ncol = 1;
	right.nzmax = right.nrow;
	right.x = const_cast<double*>(b.data());
	cholmod_dense* x = cholmod_solve(CHOLMOD_A, L, &right, &common);
	const Eigen::VectorXd out = Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(x->x), b.size());
	cholmod_free_dense(&x, &common);
	cholmod_free_factor(&L, &common);
	cholmod_free_sparse(&A, &common);
	cholmod_finish(&common);
	return out;
}
}  // namespace

TEST(CholmodOracle, SolvesTheSameSystem)
{
	for (unsigned seed = 1; seed <= 5; seed++) {
		const TPlantedGraph planted = plantedGraph(seed, 60, 80, 0.05, true);
		CMultifrontalCholesky cholesky;
		CNormalEquations system;
		system.followStructure(planted.graph, cholesky);
		system.linearize(planted.graph);
		ASSERT_TRUE(cholesky.factorize(system.H(), system.b())) << "seed " << seed;
		const Eigen::VectorXd x = cholesky.solve(),
							  oracle = solveWithCholmod(system.H().toDense(), system.b());
		EXPECT_LT((x - oracle).norm(), 1e-9 * oracle.norm()) << "seed " << seed;
	}
}
