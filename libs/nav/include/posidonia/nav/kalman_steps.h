#pragma once

#include <Eigen/Dense>

/** The arithmetic of a Kalman update in fixed sizes, for filters of any number of states N and rows M. */
namespace posidonia
{
/** P H^T for symmetric P, whole columns of P at a time, those that H does not see left out: most of H is
 * zero. */
template <int N, int M, int K, class P>
Eigen::Matrix<double, N, M> timesTransposed(const P& cov, const Eigen::Matrix<double, M, K>& H)
{
	Eigen::Matrix<double, N, M> PHt;
	for (int row = 0; row < M; row++) {
		Eigen::Matrix<double, N, 1> sum = Eigen::Matrix<double, N, 1>::Zero();
		for (int k = 0; k < K; k++)
			if (H(row, k) != 0) sum += H(row, k) * cov.col(k);
		PHt.col(row) = sum;
	}
	return PHt;
}

template <int N, int M>
struct TInnovationCovariance
{
	Eigen::Matrix<double, M, N> H;
	Eigen::Matrix<double, M, M> R, S;
	Eigen::Matrix<double, N, M> PHt;

	template <class P, class JACOBIAN, class NOISE>
	TInnovationCovariance(const P& cov, const JACOBIAN& jacobian, const NOISE& noise) : H(jacobian), R(noise)
	{
		PHt = timesTransposed<N>(cov, H);
		S = H.lazyProduct(PHt) + R;
	}
	/** P H^T S^-1 by Cholesky. */
	Eigen::Matrix<double, N, M> gain() const { return S.llt().solve(PHt.transpose()).transpose(); }
};

/** Joseph's form (I - K H) P (I - K H)^T + K R K^T, with P H^T at hand: stays positive for any K. */
template <class P, int N, int M>
void josephUpdate(P& cov, const Eigen::Matrix<double, N, M>& K, const TInnovationCovariance<N, M>& c)
{
	const Eigen::Matrix<double, N, N> A = cov - K.lazyProduct(c.PHt.transpose());
	const Eigen::Matrix<double, N, M> B = K.lazyProduct(c.R) - timesTransposed<N>(A, c.H);
	const Eigen::Matrix<double, N, N> joseph = A + B.lazyProduct(K.transpose());
	cov = 0.5 * (joseph + joseph.transpose());
}
}  // namespace posidonia
