#include <posidonia/nav/navigation_ekf.h>

namespace
{
using namespace posidonia;
using MapNav = Eigen::Map<Eigen::Matrix<double, kNavigationSize, kNavigationSize, Eigen::RowMajor>>;
using Gain = Eigen::Matrix<double, kNavigationSize, 3>;
constexpr int kClone = kMovingSize, kCloneSize = kNavigationSize - kMovingSize;

/** P <- F P F^T + Q, where only the moving rows move: P_mm and P_mc change, P_cc stays. */
void predictCovariance(MapNav& P, const MatrixMoving& F, const MatrixMoving& Q)
{
	const MatrixMoving FP = F * P.topLeftCorner<kMovingSize, kMovingSize>();
	const MatrixMoving Pmm = FP * F.transpose() + Q;
	P.topLeftCorner<kMovingSize, kMovingSize>() = 0.5 * (Pmm + Pmm.transpose());
	const Eigen::Matrix<double, kMovingSize, kCloneSize> Pmc =
		F * P.block<kMovingSize, kCloneSize>(0, kClone);
	P.block<kMovingSize, kCloneSize>(0, kClone) = Pmc;
	P.block<kCloneSize, kMovingSize>(kClone, 0) = Pmc.transpose();
}

/** Joseph's form (I - K H) P (I - K H)^T + K R K^T, with P H^T at hand. */
void updateCovariance(
	MapNav& P, const Gain& K, const CMeasurement::Jacobian& H, const Gain& PHt, const Eigen::Matrix3d& R)
{
	const MatrixNav A = P - K * PHt.transpose();
	const Gain B = K * R - A * H.transpose();
	const MatrixNav joseph = A + B * K.transpose();
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
		const Gain PHt = P * H.transpose();
		const Eigen::Matrix3d S = H * PHt + R.asEigen();
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
