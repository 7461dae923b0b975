#include <posidonia/base/chi_square.h>
#include <posidonia/nav/navigation_ekf.h>

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
TMotionInput inputOf(const CNavigationEKF::KFArray_ACT& u)
{
	return {static_cast<EDrive>(static_cast<int>(u[7])), {u[0], u[1], u[2]}, {u[3], u[4], u[5]}, u[6]};
}
}  // namespace

CNavigationEKF::CNavigationEKF(const TMotionNoise& noise, double gate_probability) : m_noise(noise)
{
	m_gate[0] = 0;
	for (int dof = 1; dof <= CMeasurement::kSize; dof++)
		m_gate[dof] = chiSquareQuantile(gate_probability, dof);
	initialize({}, MatrixMoving::Identity());
}

void CNavigationEKF::initialize(const TNavigationState& x, const MatrixMoving& cov)
{
	m_nominal = m_nominal_next = x;
	m_xkk.setZero(kNavigationSize);
	m_pkk.setZero(kNavigationSize, kNavigationSize);
	P().topLeftCorner<kMovingSize, kMovingSize>() = cov;
	clone();
}

void CNavigationEKF::save(TFilterState& to) const
{
	to.x = m_nominal;
	to.P = covariance();
}

void CNavigationEKF::restore(const TFilterState& from)
{
	m_nominal = m_nominal_next = from.x;
	m_xkk.fill(0);
	P() = from.P;
}

void CNavigationEKF::predict(const TMotionInput& u)
{
	m_input = u;
	m_nominal_next = propagated(m_nominal, u, m_noise);
	m_measurement = nullptr;
	m_observer ? predictObserved() : runOneKalmanIteration();
}

void CNavigationEKF::predictObserved()
{
	const TNavigationState before = m_nominal;
	const MatrixMoving P_before = P().topLeftCorner<kMovingSize, kMovingSize>();
	KFMatrix_VxV F;
	OnTransitionJacobian(F);
	runOneKalmanIteration();
	m_observer->predicted(
		before, P_before, F.asEigen().topLeftCorner<kMovingSize, kMovingSize>(), m_nominal,
		P().topLeftCorner<kMovingSize, kMovingSize>());
}

bool CNavigationEKF::update(const CMeasurement& measurement)
{
	fuse(measurement, true);
	return m_accepted;
}

void CNavigationEKF::updateUngated(const CMeasurement& measurement)
{
	fuse(measurement, false);
}

void CNavigationEKF::giveWay(const CMeasurement& measurement)
{
	const MatrixMoving before = P().topLeftCorner<kMovingSize, kMovingSize>();
	const int row = measurement.block();
	const Eigen::Matrix<double, CMeasurement::kSize, 3> seen =
		measurement.jacobian(m_nominal).middleCols<3>(row);
	P().block<3, 3>(row, row) += innovation(measurement).squaredNorm() * seen.transpose() * seen;
	if (m_observer)
		m_observer->predicted(
			m_nominal, before, MatrixMoving::Identity(), m_nominal,
			P().topLeftCorner<kMovingSize, kMovingSize>());
	updateUngated(measurement);
}

void CNavigationEKF::fuse(const CMeasurement& measurement, bool gated)
{
	m_input.dt = 0;
	m_measurement = &measurement;
	m_gated = gated;
	runOneKalmanIteration();
	m_measurement = nullptr;
}

void CNavigationEKF::clone()
{
	m_nominal.clone_position = m_nominal.position;
	m_nominal.R_odom_clone = m_nominal.R_odom_body;
	m_nominal_next = m_nominal;
	// The clone's rows are those of position and attitude, which are the first six.
	auto cov = P();
	cov.block<6, kMovingSize>(kClonePosition, 0) = cov.block<6, kMovingSize>(0, 0).eval();
	cov.block<kNavigationSize, 6>(0, kClonePosition) = cov.block<kNavigationSize, 6>(0, 0).eval();
}

void CNavigationEKF::anchor(const CNavigationEKF& reference)
{
	m_nominal = reference.m_nominal;
	m_nominal.position.head<2>().setZero();
	auto cov = P();
	cov = reference.covariance();
	cov.topRows<2>().setZero();
	cov.leftCols<2>().setZero();
	clone();
}

MatrixNav CNavigationEKF::covariance() const
{
	return Eigen::Map<const Eigen::Matrix<double, kNavigationSize, kNavigationSize, Eigen::RowMajor>>(
		m_pkk.data());
}

TPoseEstimate CNavigationEKF::pose() const
{
	TPoseEstimate estimate;
	estimate.T = m_nominal.T_odom_nav();
	Matrix6d J = Matrix6d::Identity();	// odom axes to the pose's own
	J.topLeftCorner<3, 3>() = m_nominal.R_odom_body.transpose();
	estimate.cov = J * covariance().topLeftCorner<6, 6>() * J.transpose();
	return estimate;
}

TPoseEstimate CNavigationEKF::sinceClone() const
{
	TPoseEstimate estimate;
	estimate.T = displacement(m_nominal);
	const auto J = displacementJacobian(m_nominal);
	const Matrix6d cov = J * covariance() * J.transpose();
	estimate.cov = 0.5 * (cov + cov.transpose());
	return estimate;
}

void CNavigationEKF::OnGetAction(KFArray_ACT& u) const
{
	for (int i = 0; i < 3; i++) {
		u[i] = m_input.rate[i];
		u[3 + i] = m_input.force[i];
	}
	u[6] = m_input.dt;
	u[7] = static_cast<double>(m_input.drive);
}

void CNavigationEKF::OnTransitionModel(const KFArray_ACT& u, KFArray_VEH& x, bool& skip) const
{
	const TMotionInput input = inputOf(u);
	skip = input.dt == 0;
	if (skip || x.asEigen().isZero(0)) return;	// no error stays none
	const TNavigationState moved = propagated(retract(m_nominal, x.asEigen()), input, m_noise);
	x.asEigen() = localCoordinates(propagated(m_nominal, input, m_noise), moved);
}

void CNavigationEKF::OnTransitionJacobian(KFMatrix_VxV& F) const
{
	m_driven = drivenJacobian(m_nominal, m_input);
	F.asEigen().setIdentity();
	F.asEigen().topLeftCorner<kDriven, kDriving>() = m_driven;
	F.asEigen().diagonal().segment<5>(kAhrsBias) = gaussMarkovDecay(m_input.dt, m_noise);
}

void CNavigationEKF::OnTransitionNoise(KFMatrix_VxV& Q) const
{
	Q.asEigen().setZero();
	Q.asEigen().topLeftCorner<kDriven, kDriven>() = drivenNoise(m_nominal, m_input, m_driven, m_noise);
	Q.asEigen().diagonal().segment<kMovingSize - kDriven>(kDriven) = walkingNoise(m_input.dt, m_noise);
}

void CNavigationEKF::OnGetObservationNoise(KFMatrix_OxO& R) const
{
	R.asEigen() = m_measurement->noise();
}

void CNavigationEKF::OnGetObservationsAndDataAssociation(
	vector_KFArray_OBS& z, std::vector<int>& association, const vector_KFArray_OBS& predictions,
	const KFMatrix& S, const std::vector<size_t>&, const KFMatrix_OxO&)
{
	association.clear();
	const CMeasurement::Value innovation =
		m_measurement->value() - CMeasurement::Value(predictions[0].asEigen());
	const CMeasurement::Noise S4 = S.asEigen().topLeftCorner<CMeasurement::kSize, CMeasurement::kSize>();
	m_last_distance = innovation.dot(S4.llt().solve(innovation));
	m_accepted = !m_gated || m_last_distance < m_gate[m_measurement->degreesOfFreedom()];
	z.clear();
	if (!m_accepted) return;
	z.emplace_back();
	z.back().asEigen() = m_measurement->value();
}

void CNavigationEKF::OnObservationModel(const std::vector<size_t>&, vector_KFArray_OBS& predictions) const
{
	predictions.clear();
	if (!m_measurement) return;
	predictions.emplace_back();
	predictions.back().asEigen() = m_measurement->predicted(m_nominal);
}

void CNavigationEKF::OnObservationJacobians(size_t, KFMatrix_OxV& Hx, KFMatrix_OxF&) const
{
	Hx.asEigen() = m_measurement->jacobian(m_nominal);
}

/** Moves the error into the nominal state and sets it to zero; after a prediction the nominal is the
 * predicted one. */
void CNavigationEKF::OnNormalizeStateVector()
{
	const VectorNav error = Eigen::Map<const VectorNav>(&m_xkk[0]);
	m_nominal = error.isZero(0) ? m_nominal_next : retract(m_nominal_next, error);
	m_nominal_next = m_nominal;
	m_xkk.fill(0);
	if (!m_measurement) return;
	resetCovariance(error.segment<3>(kAttitude), kAttitude);
	resetCovariance(error.segment<3>(kCloneAttitude), kCloneAttitude);
}

/** After the error e moved into R, what is left of it is seen from the new frame: G = Jr(e) (Sola 2017, eq.
 * 287). */
void CNavigationEKF::resetCovariance(const Vector3d& attitude_error, int rows)
{
	const Matrix3d G = rightJacobianSO3(attitude_error);
	auto cov = P();
	Eigen::Matrix<double, 3, kNavigationSize> turned = G * cov.middleRows<3>(rows);
	const Matrix3d own = turned.middleCols<3>(rows) * G.transpose();
	turned.middleCols<3>(rows) = 0.5 * (own + own.transpose());
	cov.middleRows<3>(rows) = turned;
	cov.middleCols<3>(rows) = turned.transpose();
}
}  // namespace posidonia
