#pragma once

#include <ceres/ceres.h>
#include <posidonia/posegraph/pose_graph.h>

namespace posidonia::testing
{
/** The edge's residual once more, from its definition, whitened, for Ceres' automatic derivatives. */
struct TCeresEdge
{
	Eigen::Isometry3d T_from_to;
	Matrix6d sqrt_information;

	template <class T>
	bool operator()(const T* t_i, const T* q_i, const T* t_j, const T* q_j, T* out) const
	{
		using V3 = Eigen::Matrix<T, 3, 1>;
		using Q = Eigen::Quaternion<T>;
		const Eigen::Map<const V3> ti(t_i), tj(t_j);
		const Eigen::Map<const Q> qi(q_i), qj(q_j);
		const Q q_meas(Eigen::Quaterniond(T_from_to.linear()).cast<T>());
		Q q = q_meas.conjugate() * qi.conjugate() * qj;
		if (q.w() < T(0)) q.coeffs() *= T(-1);
		Eigen::Matrix<T, 6, 1> e;
		e.template head<3>() =
			q_meas.conjugate() * (qi.conjugate() * (tj - ti) - T_from_to.translation().cast<T>());
		e.template tail<3>() = T(2) * q.vec();
		Eigen::Map<Eigen::Matrix<T, 6, 1>> r(out);
		r = sqrt_information.cast<T>() * e;
		return true;
	}
};

struct TCeresOptimum
{
	std::vector<Eigen::Isometry3d> poses;
	double cost;  ///< sum of rho(s)
};

inline ceres::LossFunction* ceresLoss(const TRobustLoss& loss)
{
	if (loss.kind == ERobustLoss::Huber) return new ceres::HuberLoss(loss.scale);
	if (loss.kind == ERobustLoss::Cauchy) return new ceres::CauchyLoss(loss.scale);
	return nullptr;
}

inline TCeresOptimum optimizeWithCeres(const CPoseGraph& graph)
{
	const int n = int(graph.nodeCount());
	std::vector<Eigen::Vector3d> t(n);
	std::vector<Eigen::Quaterniond> q(n);
	ceres::Problem problem;
	for (int i = 0; i < n; i++) {
		t[i] = graph.pose(i).translation();
		q[i] = Eigen::Quaterniond(graph.pose(i).linear());
		problem.AddParameterBlock(t[i].data(), 3);
		problem.AddParameterBlock(q[i].coeffs().data(), 4, new ceres::EigenQuaternionManifold);
		if (!graph.isFixed(i)) continue;
		problem.SetParameterBlockConstant(t[i].data());
		problem.SetParameterBlockConstant(q[i].coeffs().data());
	}
	for (const TPoseEdge& edge : graph.edges()) {
		const Matrix6d U = Eigen::LLT<Matrix6d>(edge.information).matrixU();
		problem.AddResidualBlock(
			new ceres::AutoDiffCostFunction<TCeresEdge, 6, 3, 4, 3, 4>(new TCeresEdge{edge.T_from_to, U}),
			ceresLoss(edge.loss), t[edge.from].data(), q[edge.from].coeffs().data(), t[edge.to].data(),
			q[edge.to].coeffs().data());
	}
	ceres::Solver::Options options;
	options.max_num_iterations = 500;
	options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-15;
	options.logging_type = ceres::SILENT;
	ceres::Solver::Summary summary;
	ceres::Solve(options, &problem, &summary);
	TCeresOptimum out{graph.poses(), 2 * summary.final_cost};
	for (int i = 0; i < n; i++) {
		out.poses[i].translation() = t[i];
		out.poses[i].linear() = q[i].normalized().toRotationMatrix();
	}
	return out;
}
}  // namespace posidonia::testing
