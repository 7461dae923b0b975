#include <posidonia/nav/navigation_ekf.h>

namespace
{
using namespace posidonia;
using MapNav = Eigen::Map<MatrixNav>;  // symmetric, so its storage order does not matter
using Gain = Eigen::Matrix<double, kNavigationSize, 3>;
constexpr int kClone = kMovingSize, kCloneSize = kNavigationSize - kMovingSize;

// lazyProduct: at these sizes Eigen's blocked product costs twice the arithmetic.

/** P <- F P F^T + Q. Only the moving rows move: P_mm and P_mc change, P_cc stays. Of these, velocity and bias
 * walk at random: their rows of F are those of the identity (this changes when accelerometers drive the
 * velocity). */
void predictCovariance(MapNav& P, const MatrixMoving& F, const MatrixMoving& Q)
{
	constexpr int kDriven = kVelocity, kWalking = kMovingSize - kDriven;
	const Eigen::Matrix<double, kDriven, kMovingSize> F_driven = F.topRows<kDriven>();
	const Eigen::Matrix<double, kMovingSize, kDriven> F_driven_t = F_driven.transpose();
	Eigen::Matrix<double, kMovingSize, kNavigationSize> FP = P.topRows<kMovingSize>();
	FP.topRows<kDriven>() = F_driven.lazyProduct(FP).eval();
	MatrixMoving Pmm = Q;
	Pmm.leftCols<kDriven>() += FP.leftCols<kMovingSize>().lazyProduct(F_driven_t);
	Pmm.rightCols<kWalking>() += FP.middleCols<kWalking>(kDriven);
	P.topLeftCorner<kMovingSize, kMovingSize>() = 0.5 * (Pmm + Pmm.transpose());
	P.block<kMovingSize, kCloneSize>(0, kClone) = FP.rightCols<kCloneSize>();
	P.block<kCloneSize, kMovingSize>(kClone, 0) = FP.rightCols<kCloneSize>().transpose();
}

/** Joseph's form (I - K H) P (I - K H)^T + K R K^T, with P H^T at hand. */
void updateCovariance(
	MapNav& P, const Gain& K, const CMeasurement::Jacobian& H, const Gain& PHt, const Eigen::Matrix3d& R)
{
	const MatrixNav A = P - K.lazyProduct(PHt.transpose());
	const Gain B = K.lazyProduct(R) - A.lazyProduct(H.transpose());
	const MatrixNav joseph = A + B.lazyProduct(K.transpose());
	P = 0.5 * (joseph + joseph.transpose());
}
}  // namespace

/** The steps of the stock iteration in their order, with fixed sizes, a Cholesky factor of S and Joseph's
 * form. */
template <>
void mrpt::bayes::CKalmanFilterCapable<posidonia::kNavigationSize, 3, 0, 4>::runOneKalmanIteration()
{
	MapNav P(m_pkk.data());
	Eigen::Map<VectorNav> x(&m_xkk[0]);

	KFArray_ACT u;
	OnGetAction(u);
	KFArray_VEH x_predicted;
	x_predicted.asEigen() = x;
	bool skip_prediction = false;
	OnTransitionModel(u, x_predicted, skip_prediction);
	if (!skip_prediction) {
		KFMatrix_VxV F, Q;
		OnTransitionJacobian(F);
		OnTransitionNoise(Q);
		predictCovariance(
			P, F.asEigen().topLeftCorner<kMovingSize, kMovingSize>(),
			Q.asEigen().topLeftCorner<kMovingSize, kMovingSize>());
		x = x_predicted.asEigen();
		OnNormalizeStateVector();
	}

	m_all_predictions.clear();
	OnObservationModel(m_predictLMidxs, m_all_predictions);
	if (!m_all_predictions.empty()) {
		KFMatrix_OxV Hx;
		KFMatrix_OxF Hy;
		OnObservationJacobians(0, Hx, Hy);
		KFMatrix_OxO R;
		OnGetObservationNoise(R);
		const CMeasurement::Jacobian H = Hx.asEigen();
		const Gain PHt = P.lazyProduct(H.transpose());
		const Eigen::Matrix3d S = H.lazyProduct(PHt) + R.asEigen();
		m_S.setSize(3, 3);
		m_S.asEigen() = S;
		std::vector<int> no_association;
		m_Z.clear();
		OnGetObservationsAndDataAssociation(m_Z, no_association, m_all_predictions, m_S, m_predictLMidxs, R);
		if (!m_Z.empty()) {
			const Gain K = S.llt().solve(PHt.transpose()).transpose();
			KFArray_OBS innovation = m_Z[0];
			OnSubstractObservationVectors(innovation, m_all_predictions[0]);
			x += K * innovation.asEigen();
			updateCovariance(P, K, H, PHt, R.asEigen());
			OnNormalizeStateVector();
		}
	}
	OnPostIteration();
}
