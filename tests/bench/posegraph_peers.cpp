#include "posegraph_peers.h"

#include <ceres/ceres.h>
#include <ceres_oracle.h>
#include <posidonia/posegraph/edge_residual.h>

// Of OpenBLAS and of the OpenMP run time; absent (null) where they are not linked.
extern "C" {
void openblas_set_num_threads(int) __attribute__((weak));
char* openblas_get_config() __attribute__((weak));
char* openblas_get_corename() __attribute__((weak));
void omp_set_max_active_levels(int) __attribute__((weak));
}

namespace posidonia::bench
{
namespace
{
using TPose = std::array<double, 7>;  ///< x y z qx qy qz qw
using TAmbientJacobian = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;

Eigen::Isometry3d toIsometry(const double* x)
{
	Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
	T.linear() = Eigen::Map<const Eigen::Quaterniond>(x + 3).toRotationMatrix();
	T.translation() = Eigen::Map<const Eigen::Vector3d>(x);
	return T;
}

TPose toArray(const Eigen::Isometry3d& T)
{
	TPose x;
	Eigen::Map<Eigen::Vector3d>(x.data()) = T.translation();
	Eigen::Map<Eigen::Quaterniond>(x.data() + 3) = Eigen::Quaterniond(T.linear());
	return x;
}

/** retract() of geometry/se3.h. Cost functions hand over derivatives by the tangent directly, padded with a
 * zero column, so that this manifold's own derivative is the identity, padded alike. */
class CPoseManifold : public ceres::Manifold
{
   public:
	int AmbientSize() const override { return 7; }
	int TangentSize() const override { return 6; }
	bool Plus(const double* x, const double* delta, double* sum) const override
	{
		const Eigen::Map<const Eigen::Vector3d> t(x), rho(delta), phi(delta + 3);
		const Eigen::Map<const Eigen::Quaterniond> q(x + 3);
		Eigen::Map<Eigen::Vector3d> t_sum(sum);
		Eigen::Map<Eigen::Quaterniond> q_sum(sum + 3);
		t_sum = t + q * rho;
		q_sum = (q * Eigen::Quaterniond(expSO3(phi))).normalized();
		return true;
	}
	bool PlusJacobian(const double*, double* jacobian) const override
	{
		Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> J(jacobian);
		J.setZero();
		J.topRows<6>().setIdentity();
		return true;
	}
	bool Minus(const double* y, const double* x, double* difference) const override
	{
		Eigen::Map<Vector6d> d(difference);
		d = localCoordinates(toIsometry(x), toIsometry(y));
		return true;
	}
	bool MinusJacobian(const double*, double* jacobian) const override
	{
		Eigen::Map<TAmbientJacobian> J(jacobian);
		J.setZero();
		J.leftCols<6>().setIdentity();
		return true;
	}
};

class CAnalyticEdge : public ceres::SizedCostFunction<6, 7, 7>
{
   public:
	explicit CAnalyticEdge(const TPoseEdge& edge)
		: m_edge(edge), m_sqrt_information(Eigen::LLT<Matrix6d>(edge.information).matrixU())
	{
	}
	bool Evaluate(double const* const* x, double* residual, double** jacobians) const override
	{
		const Eigen::Isometry3d from = toIsometry(x[0]), to = toIsometry(x[1]);
		Eigen::Map<Vector6d> r(residual);
		if (!jacobians) {
			r.noalias() = m_sqrt_information * edgeResidual(m_edge, from, to);
			return true;
		}
		const TEdgeJacobians d = edgeJacobians(m_edge, from, to);
		r.noalias() = m_sqrt_information * d.e;
		hand(d.J_from, jacobians[0]);
		hand(d.J_to, jacobians[1]);
		return true;
	}

   private:
	void hand(const Matrix6d& J, double* out) const
	{
		if (!out) return;
		Eigen::Map<TAmbientJacobian> ambient(out);
		ambient.leftCols<6>().noalias() = m_sqrt_information * J;
		ambient.col(6).setZero();
	}
	TPoseEdge m_edge;
	Matrix6d m_sqrt_information;
};

/** Nodes of the problem: 7 numbers each, one block or two. */
void addNodes(ceres::Problem& problem, const CPoseGraph& graph, std::vector<TPose>& poses, bool analytic)
{
	for (size_t i = 0; i < poses.size(); i++) {
		double* x = poses[i].data();
		if (analytic)
			problem.AddParameterBlock(x, 7, new CPoseManifold);
		else {
			problem.AddParameterBlock(x, 3);
			problem.AddParameterBlock(x + 3, 4, new ceres::EigenQuaternionManifold);
		}
		if (!graph.isFixed(int(i))) continue;
		problem.SetParameterBlockConstant(x);
		if (!analytic) problem.SetParameterBlockConstant(x + 3);
	}
}

void addEdges(ceres::Problem& problem, const CPoseGraph& graph, std::vector<TPose>& poses, bool analytic)
{
	using testing::TCeresEdge;
	for (const TPoseEdge& edge : graph.edges()) {
		double *from = poses[size_t(edge.from)].data(), *to = poses[size_t(edge.to)].data();
		if (analytic)
			problem.AddResidualBlock(new CAnalyticEdge(edge), nullptr, from, to);
		else
			problem.AddResidualBlock(
				new ceres::AutoDiffCostFunction<TCeresEdge, 6, 3, 4, 3, 4>(
					new TCeresEdge{edge.T_from_to, Eigen::LLT<Matrix6d>(edge.information).matrixU()}),
				nullptr, from, from + 3, to, to + 3);
	}
}
}  // namespace

TPeerResult optimizeWithCeres(CPoseGraph& graph, const TCeresOptions& options)
{
	std::vector<TPose> poses;
	for (const auto& T : graph.poses())
		poses.push_back(toArray(T));
	ceres::Problem problem;
	addNodes(problem, graph, poses, options.analytic);
	addEdges(problem, graph, poses, options.analytic);
	ceres::Solver::Options solver;
	solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
	solver.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
	solver.initial_trust_region_radius = options.initial_radius;
	solver.function_tolerance = options.function_tolerance;
	solver.jacobi_scaling = options.jacobi_scaling;
	solver.max_num_iterations = 200;
	solver.num_threads = 1;
	solver.logging_type = ceres::SILENT;
	ceres::Solver::Summary summary;
	ceres::Solve(solver, &problem, &summary);
	for (size_t i = 0; i < poses.size(); i++)
		graph.setPose(int(i), orthonormalized(toIsometry(poses[i].data())));
	return {
		summary.num_successful_steps + summary.num_unsuccessful_steps,
		summary.termination_type == ceres::CONVERGENCE};
}

void useOneThread()
{
	if (openblas_set_num_threads) openblas_set_num_threads(1);
	// CHOLMOD's loops ask for four threads whatever OMP_NUM_THREADS says.
	if (omp_set_max_active_levels) omp_set_max_active_levels(0);
}

std::string blasText()
{
	if (!openblas_get_config) return "not OpenBLAS (slow: install libopenblas0-pthread)";
	std::string text = openblas_get_config();
	if (openblas_get_corename) text += std::string(", kernels for ") + openblas_get_corename();
	return text;
}
}  // namespace posidonia::bench
