#pragma once

#include <Eigen/Dense>

namespace posidonia::testing
{
/** df/dx at zero by central differences; f maps VectorXd (n) to VectorXd (m). */
template <class F>
Eigen::MatrixXd numericalDerivative(F&& f, int n, double step = 1e-6)
{
	Eigen::MatrixXd J;
	for (int i = 0; i < n; i++) {
		Eigen::VectorXd d = Eigen::VectorXd::Zero(n);
		d[i] = step;
		const Eigen::VectorXd column = (f(d) - f(Eigen::VectorXd(-d))) / (2 * step);
		if (J.size() == 0) J.resize(column.size(), n);
		J.col(i) = column;
	}
	return J;
}
}  // namespace posidonia::testing
