#include <posidonia/nav/kalman_steps.h>
#include <posidonia/nav/navigation_ekf.h>

namespace
{
using namespace posidonia;
using MapNav = Eigen::Map<MatrixNav>;  // symmetric, so its storage order does not matter
constexpr int kObs = CMeasurement::kSize;

using Driven9 = Eigen::Matrix<double, kDriven, kDriven>;

/** P <- F P F^T + Q of the driven rows, with everything else's correlations to them; the rest of F is a
 * diagonal and comes after. */
void predictDriven(MapNav& P, const MatrixDriven& F, const Driven9& Q)
{
	constexpr int kRest = kNavigationSize - kDriven;
	const Eigen::Matrix<double, kNavigationSize, kDriven> PFt = timesTransposed<kNavigationSize>(P, F);
	const Eigen::Matrix<double, kDriving, kDriven> Ft = F.transpose();
	for (int i = 0; i < kDriven; i++)
		for (int j = 0; j <= i; j++)
			P(i, j) = P(j, i) = Q(i, j) + Ft.col(i).dot(PFt.col(j).head<kDriving>());
	P.bottomLeftCorner<kRest, kDriven>() = PFt.bottomRows<kRest>();
	P.topRightCorner<kDriven, kRest>() = PFt.bottomRows<kRest>().transpose();
}

/** The rows that walk or fade: a diagonal F and Q. */
void predictWalking(MapNav& P, const VectorNav& kept, const VectorNav& added)
{
	for (int i = kAhrsBias; i < kMovingSize; i++)
		if (kept[i] != 1) {
			P.row(i) *= kept[i];
			P.col(i) *= kept[i];
		}
	P.diagonal().segment<kMovingSize - kDriven>(kDriven) += added.segment<kMovingSize - kDriven>(kDriven);
}
}  // namespace

/** The steps of the stock iteration in their order, with fixed sizes, a Cholesky factor of S and Joseph's
 * form. */
template <>
void mrpt::bayes::CKalmanFilterCapable<posidonia::kNavigationSize, kObs, 0, 8>::runOneKalmanIteration()
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
		predictDriven(
			P, F.asEigen().topLeftCorner<kDriven, kDriving>(), Q.asEigen().topLeftCorner<kDriven, kDriven>());
		predictWalking(P, F.asEigen().diagonal(), Q.asEigen().diagonal());
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
		const TInnovationCovariance<kNavigationSize, kObs> c(P, Hx.asEigen(), R.asEigen());
		m_S.setSize(kObs, kObs);
		m_S.asEigen() = c.S;
		std::vector<int> no_association;
		m_Z.clear();
		OnGetObservationsAndDataAssociation(m_Z, no_association, m_all_predictions, m_S, m_predictLMidxs, R);
		if (!m_Z.empty()) {
			KFArray_OBS innovation = m_Z[0];
			OnSubstractObservationVectors(innovation, m_all_predictions[0]);
			const auto K = c.gain();
			x += K * innovation.asEigen();
			josephUpdate(P, K, c);
			OnNormalizeStateVector();
		}
	}
	OnPostIteration();
}
